// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fluid/field.h"

namespace cavity {

struct Extremum {
  double position, value;
};

/// A velocity component along a line, at increasing positions from wall to wall.
struct Profile {
  std::vector<double> positions, values;

  /// Cubic interpolation from the four nearest points (fewer are never stored). Throws std::invalid_argument outside.
  double at(double position) const;
  Extremum minimum() const;
  Extremum maximum() const;
};

/// Component `component` (0, 1 or 2) of the velocity along the line parallel to `axis` through the middle of the box, an axis
/// along which the component's points are cell centres. Cubic interpolation from the faces; both ends are the walls'
/// values, (first ghost + first point) / 2.
Profile centreline(const vesiflow::fluid::FaceVector& velocity, int component, int axis);

}  // namespace cavity
