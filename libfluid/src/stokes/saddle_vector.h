// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors of a velocity and a pressure, for iterative methods on both together.
#pragma once

#include "fluid/elliptic_problem.h"
#include "operators/block_algebra.h"
#include "operators/stencil.h"

namespace vesiflow::fluid {

// Unknowns laid out as fields, zero at first.
struct SaddleVector {
  explicit SaddleVector(const Grid& grid)
      : velocity(EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, 1.0)),
        pressure(EllipticProblem::pressure(grid)) {}

  Blocks u() { return velocity.unknowns(); }
  ConstBlocks u() const { return velocity.unknowns(); }
  View p() { return pressure.unknowns()[0]; }
  ConstView p() const { return pressure.unknowns()[0]; }

  GhostedBlocks velocity, pressure;
};

inline void copy(const SaddleVector& x, SaddleVector& y) {
  copy(x.u(), y.u());
  copy(x.p(), y.p());
}

inline void set_zero(SaddleVector& y) {
  set_zero(y.u());
  set_zero(y.p());
}

inline void add(double factor, const SaddleVector& x, SaddleVector& y) {
  add(factor, x.u(), y.u());
  add(factor, x.p(), y.p());
}

inline double dot(PlaneSums& sums, const SaddleVector& x, const SaddleVector& y) {
  return sums.dot(x.u(), y.u()) + sums.dot(x.p(), y.p());
}

}  // namespace vesiflow::fluid
