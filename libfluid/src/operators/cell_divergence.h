// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The divergence of one cell: shared by divergence() and the time step.
#pragma once

#include "fluid/field.h"

namespace vesiflow::fluid {

// div u in one cell, from pointers to the velocity at its lower faces.
struct CellDivergence {
  explicit CellDivergence(const FaceVector& u)
      : y_stride(u.y.stride(1)),
        z_stride(u.z.stride(2)),
        per_h{1.0 / u.grid().spacing(0), 1.0 / u.grid().spacing(1), 1.0 / u.grid().spacing(2)} {}
  double operator()(const double* x, const double* y, const double* z) const {
    return (x[1] - x[0]) * per_h[0] + (y[y_stride] - y[0]) * per_h[1] + (z[z_stride] - z[0]) * per_h[2];
  }
  std::ptrdiff_t y_stride, z_stride;
  Vector3 per_h;
};

}  // namespace vesiflow::fluid
