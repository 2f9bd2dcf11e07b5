// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The Stokes system with variable viscosity: conjugate gradients for velocity and pressure together.
#pragma once

#include "operators/block_algebra.h"
#include "stokes/saddle_solver.h"
#include "stokes/saddle_vector.h"
#include "stokes/velocity_multigrid.h"

namespace vesiflow::fluid {

// The conjugate gradients of Bramble & Pasciak 1988 (doi:10.1090/S0025-5718-1988-0917816-8). The block triangular
// preconditioner
//   M = (A0   0 )     A0 = s P,  P^-1 a multigrid cycle for A,
//       (B   -S0)     S0^-1 = 2 mu, as S = B A^-1 B^T is 1 / (2 mu) away from walls for constant mu,
// makes M^-1 K symmetric and positive in the inner product H = diag(A - A0, S0), if s is below all eigenvalues of P^-1 A.
// A larger s converges faster although a few directions are then negative in H, but without a guarantee. So s begins
// there, and when the residual has not reached a new minimum for many iterations it is lowered, and the iteration starts
// again from the x it has.
class BramblePasciakSolver final : public SaddleSolver {
 public:
  explicit BramblePasciakSolver(const Grid& grid);
  void update(const Viscosity& mu);
  const Stencil& viscous_operator() const override { return multigrid_.viscous_operator(); }
  double norm(const SaddleVector& r) override;
  SaddleProgress solve(SaddleVector& r, double target, int max_iterations, SaddleVector& x) override;

 private:
  enum class Outcome { finished, stagnated };
  Outcome iterate(double s, SaddleVector& r, double target, int max_iterations, SaddleVector& x,
                  SaddleProgress& progress);
  double divergence_norm2(const SaddleVector& r);
  void multiply_by_viscosity(double factor, ConstView p, View product) const;

  Grid grid_;
  Viscosity mu_ = 1.0;
  VelocityMultigrid multigrid_;
  SaddleVector preconditioned_, direction_, product_, work_;  // M^-1 r, p, K p
  GhostedBlocks viscous_direction_;                           // A p
  PlaneSums sums_;
};

}  // namespace vesiflow::fluid
