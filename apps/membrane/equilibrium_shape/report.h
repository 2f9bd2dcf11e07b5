// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "equilibrium.h"

namespace equilibrium {

struct Failure {
  double reduced_volume = 1;
  std::string message;
};
using Outcome = std::variant<Equilibrium, Failure>;

/// One line of progress.
std::string describe(const Equilibrium& shape);
/// The table that people read.
std::string table(const std::vector<Outcome>& outcomes);
/// The same for programs, with all digits and all that proves the shapes; what is undefined is null.
nlohmann::json to_json(const std::vector<Outcome>& outcomes, Branch branch, int latitudes, Method method);

}  // namespace equilibrium
