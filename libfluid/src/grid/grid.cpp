// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {

Grid::Grid(const Vector3& lower_, const Vector3& upper_, const std::array<int, 3>& cells_, const AxisEnds& ends)
    : lower(lower_), upper(upper_), cells(cells_), periodic(ends.periodic), mirror(ends.mirror) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(lower[axis]) || !std::isfinite(upper[axis]) || !(upper[axis] > lower[axis])) {
      throw std::invalid_argument(message("grid: axis ", axis, " runs from ", lower[axis], " to ", upper[axis],
                                          "; both must be finite and the upper end larger"));
    }
    if (!std::isfinite(length(axis))) {
      throw std::invalid_argument(message("grid: the length of axis ", axis, " overflows"));
    }
    if (cells[axis] < min_cells || cells[axis] > max_cells) {
      throw std::invalid_argument(message("grid: ", cells[axis], " cells along axis ", axis, "; at least ", min_cells,
                                          " are needed, and at most ", max_cells, " allowed"));
    }
    if (periodic[axis] && mirror[axis]) {
      throw std::invalid_argument(
          message("grid: axis ", axis, " is periodic and has a mirror; it can only be one of the two"));
    }
  }
}

double Grid::min_spacing() const {
  return std::min({spacing(0), spacing(1), spacing(2)});
}

std::size_t Grid::cell_count() const {
  return static_cast<std::size_t>(cells[0]) * cells[1] * cells[2];
}

}  // namespace vesiflow::fluid
