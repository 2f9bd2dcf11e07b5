// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// The uniform staggered (MAC) grid of a box, each axis of which ends at two walls, begins at a plane of symmetry or is
/// periodic.
#pragma once

#include <array>
#include <cstddef>

#include "fluid/export.h"

namespace vesiflow::fluid {

using Vector3 = std::array<double, 3>;  ///< a point or vector of space

/// What the ends of the axes are, where they are not two walls.
struct AxisEnds {
  std::array<bool, 3> periodic{};  ///< per axis: what leaves at one end comes in at the other
  std::array<bool, 3> mirror{};    ///< per axis: the lower end is a plane of symmetry in the place of a wall
};

/// A box [lower, upper] cut into cells[0] x cells[1] x cells[2] equal cells; lengths are dimensionless (in
/// units of the vesicle's radius). The mesh width may differ from axis to axis, and any number of cells from 4
/// up is allowed.
///
/// Where things live: pressure at cell centres; the velocity component along an axis at the centres of the
/// faces normal to it, the faces on the two walls included (see field.h).
///
/// An axis with a mirror holds the upper half of a box, twice as long and with twice the cells, in which everything is
/// symmetric about the plane of the lower end. There is no wall there: across it the velocity component along the axis
/// is odd (and so zero on it), the other components, the pressure and the viscosity are even. The upper end is a wall.
/// What is computed on the half is, to round-off, what would be on the whole. Up to three axes may have a mirror: two
/// leave a quarter of the box to compute.
struct VESIFLOW_FLUID_EXPORT Grid {
  static constexpr int min_cells = 4;      ///< fewest cells along an axis
  static constexpr int max_cells = 65536;  ///< most cells along an axis: indices of the whole array then fit 64 bits

  /// \throws std::invalid_argument naming the value unless upper > lower (both finite) and min_cells <= cells <=
  /// max_cells, and if an axis is both periodic and has a mirror.
  Grid(const Vector3& lower, const Vector3& upper, const std::array<int, 3>& cells, const AxisEnds& ends = {});

  Vector3 lower;                 ///< lower corner of the box
  Vector3 upper;                 ///< upper corner of the box
  std::array<int, 3> cells;      ///< number of cells along each axis
  std::array<bool, 3> periodic;  ///< see AxisEnds
  std::array<bool, 3> mirror;    ///< see AxisEnds

  double length(int axis) const { return upper[axis] - lower[axis]; }          ///< length of the box along an axis
  double spacing(int axis) const { return length(axis) / cells[axis]; }        ///< mesh width h along an axis
  double min_spacing() const;                                                  ///< smallest mesh width
  double cell_volume() const { return spacing(0) * spacing(1) * spacing(2); }  ///< volume of a cell
  std::size_t cell_count() const;                                              ///< number of cells

  /// Whether there is a wall at the lower (side 0) or upper (side 1) end of an axis.
  bool has_wall(int axis, int side) const { return !periodic[axis] && !(mirror[axis] && side == 0); }
  bool has_walls() const { return !(periodic[0] && periodic[1] && periodic[2]); }  ///< whether there is any wall

  friend bool operator==(const Grid&, const Grid&) = default;  ///< the same box, cells and ends
};

}  // namespace vesiflow::fluid
