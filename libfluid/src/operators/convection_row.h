// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// One row of the convection operator: shared by convection() and the time step.
#pragma once

#include <array>

#include "fluid/field.h"

namespace vesiflow::fluid {

// First and one-past-last unknown of a velocity component, counted in points.
struct UnknownRange {
  std::array<int, 3> begin, end;
  bool contains_row(int j, int k) const { return begin[1] <= j && j < end[1] && begin[2] <= k && k < end[2]; }
};
UnknownRange unknown_range(const Grid& grid, int component);

// Sets out[i] = N_c(u) at the unknowns i of row (j, k) of a component; out[0] belongs to point (0, j, k).
//
// Never inlined: a restored run computes the convection of the previous velocity here, where the
// uninterrupted run computed it one step earlier, and both must get the same instructions and so the same
// bits.
[[gnu::noinline]] void convection_row(const Grid& grid, const std::array<ConstView, 3>& u, int component, int j, int k,
                                      double* out);

}  // namespace vesiflow::fluid
