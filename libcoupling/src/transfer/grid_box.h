// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "fluid/centring.h"
#include "fluid/grid.h"

namespace vesiflow::coupling {

/// A box of points of one centring of a grid, which are numbered with x fastest. Indices run on across periodic axes:
/// i and i + cells are the same point of the grid.
struct GridBox {
  GridBox(const fluid::Grid& grid, fluid::Centring centring)
      : origin(fluid::point_position(grid, centring, 0, 0, 0)),
        spacing{grid.spacing(0), grid.spacing(1), grid.spacing(2)},
        per_spacing{1.0 / spacing[0], 1.0 / spacing[1], 1.0 / spacing[2]} {}

  fluid::Vector3 origin;   ///< position of the point (0, 0, 0)
  fluid::Vector3 spacing;  ///< of points
  fluid::Vector3 per_spacing;
  std::array<int, 3> first{}, extent{};

  std::size_t size() const {
    return static_cast<std::size_t>(extent[0]) * static_cast<std::size_t>(extent[1]) *
           static_cast<std::size_t>(extent[2]);
  }
  int last(int axis) const { return first[axis] + extent[axis] - 1; }
  bool contains(int i, int j, int k) const {
    return i >= first[0] && i <= last(0) && j >= first[1] && j <= last(1) && k >= first[2] && k <= last(2);
  }
  std::ptrdiff_t offset(int i, int j, int k) const {
    return (std::ptrdiff_t{k - first[2]} * extent[1] + (j - first[1])) * extent[0] + (i - first[0]);
  }
  std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? extent[0] : std::ptrdiff_t{extent[0]} * extent[1];
  }
  double coordinate(int axis, int index) const { return origin[axis] + index * spacing[axis]; }
  /// Where a coordinate is, in indices.
  double index_at(int axis, double x) const { return (x - origin[axis]) * per_spacing[axis]; }
};

}  // namespace vesiflow::coupling
