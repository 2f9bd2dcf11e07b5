// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/following_parameters.h"

#include <algorithm>

#include "motion/constants.h"

namespace vesiflow::coupling {

MembraneResponse FollowingParameters::response() const {
  return {std::max(shape.degrees, grid.degrees), shape.radius, grid.spacing, grid.thickness, grid.is_sharp};
}

int grid_degrees(double radius, double spacing) {
  return static_cast<int>(constants::largest_resolved_kh * radius / spacing);
}

int resolved_degrees(int chosen, double radius, double spacing) {
  return std::max(constants::fewest_degrees, std::min(chosen, grid_degrees(radius, spacing)));
}

int sharp_degrees(double radius, double spacing) {
  return std::max(constants::fewest_degrees,
                  1 + static_cast<int>(constants::largest_resolved_kh_of_sharp_membrane * radius / spacing));
}

}  // namespace vesiflow::coupling
