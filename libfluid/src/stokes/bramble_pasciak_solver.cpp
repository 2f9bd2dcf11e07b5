// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stokes/bramble_pasciak_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grid/planes.h"
#include "stokes/stokes_operator.h"

namespace vesiflow::fluid {
namespace {

// Most eigenvalues of the cycle times A are between this and 1.
constexpr double first_scale = 0.4;
constexpr double lowering = 0.5;
constexpr int patience = 40;

}  // namespace

BramblePasciakSolver::BramblePasciakSolver(const Grid& grid)
    : grid_(grid),
      multigrid_(grid),
      preconditioned_(grid),
      direction_(grid),
      product_(grid),
      work_(grid),
      viscous_direction_(EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, 1.0)),
      sums_(grid.cells[2] + 1) {}

void BramblePasciakSolver::update(const Viscosity& mu) {
  mu_ = mu;
  multigrid_.update(mu);
}

void BramblePasciakSolver::multiply_by_viscosity(double factor, ConstView p, View product) const {
  const ConstView mu = mu_.field().points();
  for_each_plane(p.extent, [&](int k) {
    for (int j = 0; j < p.extent[1]; ++j) {
      const double* m = mu.row(j, k);
      const double* from = p.row(j, k);
      double* to = product.row(j, k);
#pragma omp simd
      for (int i = 0; i < p.extent[0]; ++i) to[i] = factor * m[i] * from[i];
    }
  });
}

// <r_p, mu r_p>.
double BramblePasciakSolver::divergence_norm2(const SaddleVector& r) {
  multiply_by_viscosity(1.0, r.p(), work_.p());
  return sums_.dot(r.p(), work_.p());
}

double BramblePasciakSolver::norm(const SaddleVector& r) {
  multigrid_.apply(r.u(), preconditioned_.u());
  return std::sqrt(sums_.dot(r.u(), preconditioned_.u()) + divergence_norm2(r));
}

SaddleProgress BramblePasciakSolver::solve(SaddleVector& r, double target, int max_iterations, SaddleVector& x) {
  SaddleProgress progress{0, 0.0};
  set_zero(x);
  double s = first_scale;
  while (iterate(s, r, target, max_iterations, x, progress) == Outcome::stagnated) s *= lowering;
  return progress;
}

// In the names of the header, with z = M^-1 r, k = K p and t = A0^-1 k_u:
//   (z, z)_H = <A z_u - r_u, z_u> + <B z_u - r_p, z_p>,   (M^-1 K p, p)_H = <t - p_u, k_u> - <k_p, p_p>.
// A p follows from A z as p does from z, so that each iteration takes one cycle and one product with A.
BramblePasciakSolver::Outcome BramblePasciakSolver::iterate(double s, SaddleVector& r, double target,
                                                            int max_iterations, SaddleVector& x,
                                                            SaddleProgress& progress) {
  SaddleVector& z = preconditioned_;
  SaddleVector& p = direction_;
  SaddleVector& k = product_;
  const Blocks ap = viscous_direction_.unknowns();
  multigrid_.apply(r.u(), z.u());
  scale(1.0 / s, z.u());
  double zz = 0.0;
  double least = 0.0;
  int last_progress = 0;
  for (bool first = true;; first = false) {
    const double velocity_norm2 = std::max(0.0, s * sums_.dot(r.u(), z.u()));
    progress.norm = std::sqrt(velocity_norm2 + divergence_norm2(r));
    if (!(progress.norm > target) || progress.iterations == max_iterations) return Outcome::finished;
    if (first || progress.norm < least) {
      least = progress.norm;
      last_progress = progress.iterations;
    } else if (progress.iterations - last_progress == patience) {
      return Outcome::stagnated;
    }

    const Blocks az = work_.u();
    multigrid_.viscous_operator().apply(z.velocity, az);
    negative_divergence(grid_, std::as_const(z.velocity).points(), work_.p());
    add(-1.0, r.p(), work_.p());
    multiply_by_viscosity(2.0, work_.p(), z.p());
    const double previous =
        std::exchange(zz, sums_.dot(az, z.u()) - sums_.dot(r.u(), z.u()) + sums_.dot(work_.p(), z.p()));
    if (first) {
      copy(z, p);
      copy(az, ap);
    } else {
      scale_and_add(zz / previous, z.u(), p.u());
      scale_and_add(zz / previous, z.p(), p.p());
      scale_and_add(zz / previous, az, ap);
    }

    copy(ap, k.u());
    add_gradient(grid_, p.pressure, k.u());
    p.velocity.set_ghosts();
    negative_divergence(grid_, std::as_const(p.velocity).points(), k.p());
    const Blocks t = work_.u();
    multigrid_.apply(k.u(), t);
    scale(1.0 / s, t);
    const double pp = sums_.dot(t, k.u()) - sums_.dot(p.u(), k.u()) - sums_.dot(k.p(), p.p());
    const double step = zz / pp;
    add(step, p, x);
    add(-step, k, r);
    add(-step, t, z.u());
    ++progress.iterations;
  }
}

}  // namespace vesiflow::fluid
