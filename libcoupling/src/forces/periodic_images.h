// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "fluid/grid.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// The smallest box along the axes that holds the markers of a membrane.
struct Bounds {
  explicit Bounds(const vesicle::VectorField& markers)
      : lower(markers.colwise().minCoeff().matrix().transpose()),
        upper(markers.colwise().maxCoeff().matrix().transpose()) {}

  /// From any point of one to any point of the other, at least.
  double distance_to(const Bounds& other, const vesicle::Vector3& shift) const {
    const vesicle::Vector3 gap = (lower - other.upper - shift).cwiseMax(other.lower + shift - upper);
    return gap.cwiseMax(0.0).norm();
  }

  vesicle::Vector3 lower, upper;
};

/// visit(shift) for every shift by whole periods, zero included, that brings b to within `range` of a along each axis. Vesicles
/// are not wrapped into the box, so any number of periods may lie between two that are near each other.
template <class Visit>
void for_each_image(const fluid::Grid& grid, const Bounds& a, const Bounds& b, double range, Visit&& visit) {
  std::array<int, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = a.lower(axis) - range - b.upper(axis), high = a.upper(axis) + range - b.lower(axis);
    if (grid.periodic[axis]) {
      first[axis] = static_cast<int>(std::ceil(low / grid.length(axis)));
      last[axis] = static_cast<int>(std::floor(high / grid.length(axis)));
    } else if (low > 0.0 || high < 0.0) {
      return;
    }
  }
  for (int i = first[0]; i <= last[0]; ++i)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int k = first[2]; k <= last[2]; ++k)
        visit(vesicle::Vector3(i * grid.length(0), j * grid.length(1), k * grid.length(2)));
}

/// Of the shifts of a membrane against itself, one of each two opposite ones, and not zero.
inline bool is_first_of_two(const vesicle::Vector3& shift) {
  for (int axis = 0; axis < 3; ++axis)
    if (shift(axis) != 0.0) return shift(axis) > 0.0;
  return false;
}

}  // namespace vesiflow::coupling
