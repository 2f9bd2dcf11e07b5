// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cavity_flow.h"

namespace cavity {

/// Extrema on the centrelines grid by grid, and at the published Reynolds number the published profiles beside ours. With
/// two grids or more also their extrapolation to h = 0 from the last two, taking errors as O(h^2).
std::string table(const std::vector<CavityFlow>& flows, double reynolds_number);

nlohmann::ordered_json to_json(const std::vector<CavityFlow>& flows, double reynolds_number);

/// CSV of x, y, u, v at the cell centres of the plane z = 1/2.
std::string mid_plane(const CavityFlow& flow);

}  // namespace cavity
