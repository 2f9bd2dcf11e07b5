// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The Stokes system with constant viscosity: conjugate gradients for the pressure, with fast velocity solves.
#pragma once

#include <memory>

#include "fluid/elliptic_solver.h"
#include "operators/block_algebra.h"
#include "stokes/saddle_solver.h"
#include "stokes/saddle_vector.h"

namespace vesiflow::fluid {

// Eliminates the velocity: S p = B A^-1 r_u - r_p with S = B A^-1 B^T, B = -div, A = -mu Lap. As div u = 0 the laplacian
// and the stress form have the same solution. The eigenvalues of mu S are 1 without walls; with walls they lie
// between a number that depends on the shape of the box, but not on the grid, and 1.
class SchurComplementSolver final : public SaddleSolver {
 public:
  SchurComplementSolver(const Grid& grid, double mu);
  void update(double mu);
  const Stencil& viscous_operator() const override { return *stencil_; }
  double norm(const SaddleVector& r) override;
  SaddleProgress solve(SaddleVector& r, double target, int max_iterations, SaddleVector& x) override;

 private:
  Grid grid_;
  double mu_;
  std::unique_ptr<EllipticSolver> velocity_solver_;
  std::unique_ptr<Stencil> stencil_;
  SaddleVector direction_, response_;  // p and A^-1 B^T p; B A^-1 B^T p
  PlaneSums sums_;
};

}  // namespace vesiflow::fluid
