// The uniform staggered (MAC) grid of a box, each axis of which ends at two walls or is periodic.
#pragma once

#include <array>
#include <cstddef>

namespace vesiflow::fluid {

using Vector3 = std::array<double, 3>;

// A box [lower, upper] cut into cells[0] x cells[1] x cells[2] equal cells; lengths are dimensionless (in
// units of the vesicle's radius). The mesh width may differ from axis to axis, and any number of cells from 4
// up is allowed.
//
// Where things live: pressure at cell centres; the velocity component along an axis at the centres of the
// faces normal to it, the faces on the two walls included (see field.h).
struct Grid {
  static constexpr int min_cells = 4;
  static constexpr int max_cells = 65536;  // per axis: indices of the whole array then fit 64 bits

  // Throws std::invalid_argument, naming the value, unless upper > lower (both finite) and
  // min_cells <= cells <= max_cells.
  Grid(const Vector3& lower, const Vector3& upper, const std::array<int, 3>& cells,
       const std::array<bool, 3>& periodic = {false, false, false});

  Vector3 lower;
  Vector3 upper;
  std::array<int, 3> cells;
  std::array<bool, 3> periodic;  // per axis: what leaves at one end comes in at the other; else there are walls

  double length(int axis) const { return upper[axis] - lower[axis]; }
  double spacing(int axis) const { return length(axis) / cells[axis]; }
  double min_spacing() const;
  double cell_volume() const { return spacing(0) * spacing(1) * spacing(2); }
  std::size_t cell_count() const;
  bool has_walls() const { return !(periodic[0] && periodic[1] && periodic[2]); }

  friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace vesiflow::fluid
