// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// The four places of the staggered grid, as values (for solvers) and as types (for fields).
#pragma once

#include <array>

#include "fluid/export.h"
#include "fluid/grid.h"

namespace vesiflow::fluid {

/// Where the points of a quantity are: at the centres of cells, or at the centres of the faces normal to an axis.
enum class Centring {
  cell,    ///< pressure, viscosity
  face_x,  ///< velocity component along x
  face_y,  ///< velocity component along y
  face_z   ///< velocity component along z
};

/// Tag of a Field at cell centres. The tags keep quantities of different centring apart at compile time.
struct Cell {
  static constexpr Centring centring = Centring::cell;  ///< the same as a value
};
/// Tag of a Field at the centres of the faces normal to x.
struct FaceX {
  static constexpr Centring centring = Centring::face_x;  ///< the same as a value
};
/// Tag of a Field at the centres of the faces normal to y.
struct FaceY {
  static constexpr Centring centring = Centring::face_y;  ///< the same as a value
};
/// Tag of a Field at the centres of the faces normal to z.
struct FaceZ {
  static constexpr Centring centring = Centring::face_z;  ///< the same as a value
};

/// The centrings of the components of a velocity.
inline constexpr std::array<Centring, 3> face_centrings{Centring::face_x, Centring::face_y, Centring::face_z};

/// "cell", "face_x", ... for messages.
VESIFLOW_FLUID_EXPORT const char* name(Centring centring);

/// Whether points of this centring lie on the walls (or the mirror) normal to the axis (true for face_x and axis 0, and
/// so on).
constexpr bool is_face_normal(Centring centring, int axis) {
  return static_cast<int>(centring) == axis + 1;
}

/// Number of points along each axis: one per cell, and one more along the normal of a face (on a periodic axis the last
/// of these is the first again).
VESIFLOW_FLUID_EXPORT std::array<int, 3> point_extent(const Grid& grid, Centring centring);

/// Number of unknowns along each axis: the points that do not lie on a wall or a mirror, each counted once.
VESIFLOW_FLUID_EXPORT std::array<int, 3> unknown_extent(const Grid& grid, Centring centring);

/// The index of the first unknown along an axis: 1 along the normal of a face unless it is periodic, else 0.
constexpr int first_unknown(const Grid& grid, Centring centring, int axis) {
  return is_face_normal(centring, axis) && !grid.periodic[axis] ? 1 : 0;
}

/// Position of point (i, j, k); indices outside the extent give the positions of ghosts.
inline Vector3 point_position(const Grid& grid, Centring centring, int i, int j, int k) {
  const std::array<int, 3> index{i, j, k};
  Vector3 position{};
  for (int axis = 0; axis < 3; ++axis) {
    const double offset = is_face_normal(centring, axis) ? 0.0 : 0.5;
    position[axis] = grid.lower[axis] + (index[axis] + offset) * grid.spacing(axis);
  }
  return position;
}

}  // namespace vesiflow::fluid
