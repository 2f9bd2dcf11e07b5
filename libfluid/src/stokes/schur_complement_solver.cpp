// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stokes/schur_complement_solver.h"

#include <cmath>
#include <utility>

#include "stokes/stokes_operator.h"

namespace vesiflow::fluid {
namespace {

EllipticProblem velocity_problem(const Grid& grid, double mu) {
  return EllipticProblem::velocity(grid, EllipticForm::laplacian, 0.0, mu);
}

}  // namespace

SchurComplementSolver::SchurComplementSolver(const Grid& grid, double mu)
    : grid_(grid),
      mu_(mu),
      velocity_solver_(make_elliptic_solver(velocity_problem(grid, mu), FftOptions{})),
      direction_(grid),
      response_(grid),
      sums_(grid.cells[2] + 1) {
  update(mu);
}

void SchurComplementSolver::update(double mu) {
  mu_ = mu;
  velocity_solver_->update(velocity_problem(grid_, mu));
  stencil_ = std::make_unique<Stencil>(velocity_problem(grid_, mu));
}

double SchurComplementSolver::norm(const SaddleVector& r) {
  velocity_solver_->solve(r.u(), response_.u());
  return std::sqrt(sums_.dot(r.u(), response_.u()) + mu_ * sums_.dot(r.p(), r.p()));
}

// The velocity equation holds to round-off all along, and the residual is that of the divergence.
SaddleProgress SchurComplementSolver::solve(SaddleVector& r, double target, int max_iterations, SaddleVector& x) {
  const View residual = r.p();
  velocity_solver_->solve(r.u(), x.u());
  x.velocity.set_ghosts();
  negative_divergence(grid_, std::as_const(x.velocity).points(), response_.p());
  add(-1.0, response_.p(), residual);
  set_zero(x.p());

  SaddleProgress progress{0, 0.0};
  double rr = sums_.dot(residual, residual);
  for (;; ++progress.iterations) {
    progress.norm = std::sqrt(mu_ * rr);
    if (!(progress.norm > target) || progress.iterations == max_iterations) return progress;
    if (progress.iterations == 0) copy(residual, direction_.p());
    set_zero(direction_.u());
    add_gradient(grid_, direction_.pressure, direction_.u());
    velocity_solver_->solve(direction_.u(), direction_.u());
    direction_.velocity.set_ghosts();
    negative_divergence(grid_, std::as_const(direction_.velocity).points(), response_.p());
    const double step = rr / sums_.dot(direction_.p(), response_.p());
    // S p = B A^-1 r_u - r_p: minus the residual here.
    add(-step, direction_.p(), x.p());
    add(step, direction_.u(), x.u());
    add(-step, response_.p(), residual);
    const double previous = std::exchange(rr, sums_.dot(residual, residual));
    scale_and_add(rr / previous, residual, direction_.p());
  }
}

}  // namespace vesiflow::fluid
