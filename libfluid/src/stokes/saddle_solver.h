// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What StokesSolver needs of a method.
#pragma once

#include "stokes/saddle_vector.h"

namespace vesiflow::fluid {

struct SaddleProgress {
  int iterations;
  double norm;  // of the last residual
};

// Solves   A u + B^T p = r_u,   B u = r_p,   B = -div,   with homogeneous walls.
class SaddleSolver {
 public:
  virtual ~SaddleSolver() = default;
  // A: the stress form, or another that is equal to it if div u = 0.
  virtual const Stencil& viscous_operator() const = 0;
  // The norm in which StokesSolver measures residuals.
  virtual double norm(const SaddleVector& r) = 0;
  // Sets x, until the norm of the residual is not above the target. r is lost.
  virtual SaddleProgress solve(SaddleVector& r, double target, int max_iterations, SaddleVector& x) = 0;
};

}  // namespace vesiflow::fluid
