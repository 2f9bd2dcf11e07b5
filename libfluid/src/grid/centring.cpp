// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/centring.h"

namespace vesiflow::fluid {

const char* name(Centring centring) {
  switch (centring) {
    case Centring::cell:
      return "cell";
    case Centring::face_x:
      return "face_x";
    case Centring::face_y:
      return "face_y";
    case Centring::face_z:
      return "face_z";
  }
  return "unknown centring";
}

std::array<int, 3> point_extent(const Grid& grid, Centring centring) {
  std::array<int, 3> extent = grid.cells;
  for (int axis = 0; axis < 3; ++axis) {
    if (is_face_normal(centring, axis)) ++extent[axis];
  }
  return extent;
}

std::array<int, 3> unknown_extent(const Grid& grid, Centring centring) {
  std::array<int, 3> extent = grid.cells;
  for (int axis = 0; axis < 3; ++axis) extent[axis] -= first_unknown(grid, centring, axis);
  return extent;
}

}  // namespace vesiflow::fluid
