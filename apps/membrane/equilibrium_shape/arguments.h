// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "equilibrium.h"

namespace equilibrium {

struct Arguments {
  Branch branch = Branch::prolate;
  std::vector<double> reduced_volumes;
  int latitudes = 32;
  Method method = Method::gradient_flow;
  double tolerance = 1e-9;
  int most_iterations = 0;
  std::filesystem::path out;  ///< empty: no files
  bool json = false, verbose = false, quiet = false;
};

/// The reduced volumes of "0.9" or of "FROM:TO:STEP", both ends included, in either direction.
/// @throws CommandLineError of program.h
std::vector<double> parse_reduced_volumes(const std::string& text);

/// False if only help was asked for, which is then printed.
/// @throws CommandLineError
bool read_command_line(int argc, char** argv, Arguments& arguments);

}  // namespace equilibrium
