// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stokes/velocity_multigrid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "grid/planes.h"
#include "operators/block_algebra.h"

namespace vesiflow::fluid {
namespace {

// Damping of the Jacobi smoothing, one step before and one after the correction from the coarser grid. The diagonally
// scaled operator has no eigenvalue above 4: an edge adds mu (a + b)^2 <= 2 mu (a^2 + b^2) to the dissipation, and each
// difference a^2 <= 2 (u_1^2 + u_2^2) / h^2 of neighbours, mu u^2 / h^2 of which is the diagonal's. As 4 damping
// is below 2, errors never grow, and those that a coarser grid cannot represent shrink evenly.
constexpr double damping = 1.0 / 2.2;
// Of the error on the coarsest grid.
constexpr double coarsest_reduction = 0.1;

EllipticProblem viscous_problem(const Grid& grid, const Viscosity& mu) {
  return EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, mu);
}

bool can_be_coarsened(const Grid& grid, int axis) {
  return (grid.cells[axis] + 1) / 2 >= Grid::min_cells;
}

// The same grid if it is the coarsest.
Grid coarsened(const Grid& grid) {
  double smallest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!can_be_coarsened(grid, axis)) continue;
    if (smallest == 0.0 || grid.spacing(axis) < smallest) smallest = grid.spacing(axis);
  }
  auto cells = grid.cells;
  for (int axis = 0; axis < 3; ++axis) {
    if (can_be_coarsened(grid, axis) && grid.spacing(axis) < 1.5 * smallest) cells[axis] = (cells[axis] + 1) / 2;
  }
  return {grid.lower, grid.upper, cells, {.periodic = grid.periodic, .mirror = grid.mirror}};
}

// Coefficients of the Chebyshev iteration d = a d + b P^-1 r, x += d for eigenvalues of P^-1 A in an interval (Saad,
// Iterative Methods for Sparse Linear Systems (2003), algorithm 12.1).
class ChebyshevSteps {
 public:
  ChebyshevSteps(double min, double max) : delta_(0.5 * (max - min)), sigma_((max + min) / (max - min)) {}
  struct Coefficients {
    double a, b;
  };
  Coefficients next() {
    if (rho_ == 0.0) {
      rho_ = 1.0 / sigma_;
      return {0.0, rho_ / delta_};
    }
    const double previous = std::exchange(rho_, 1.0 / (2.0 * sigma_ - rho_));
    return {rho_ * previous, 2.0 * rho_ / delta_};
  }
  // For a reduction of all errors in the interval.
  int steps(double reduction) const {
    return static_cast<int>(std::ceil(std::acosh(1.0 / reduction) / std::acosh(sigma_)));
  }

 private:
  double delta_, sigma_;
  double rho_ = 0.0;
};

}  // namespace

class VelocityMultigrid::Level {
 public:
  explicit Level(const Grid& grid_)
      : grid(grid_),
        x(viscous_problem(grid_, 1.0)),
        rhs(viscous_problem(grid_, 1.0)),
        residual(viscous_problem(grid_, 1.0)),
        inverse_diagonal_(viscous_problem(grid_, 1.0)) {}

  void connect(const Grid& coarse) {
    for (const Centring centring : face_centrings) {
      const auto lines = [&](auto&& line) { return TensorMap({line(0), line(1), line(2)}); };
      to_coarse.push_back(lines([&](int axis) { return LineMap::restriction(grid, coarse, centring, axis); }));
      from_coarse.push_back(lines([&](int axis) { return LineMap::interpolation(coarse, grid, centring, axis); }));
    }
    const auto average = [&](int axis) { return LineMap::cell_average(grid, coarse, axis); };
    average_.emplace(std::array<LineMap, 3>{average(0), average(1), average(2)});
    coarse_viscosity_ = std::make_shared<Field<Cell>>(coarse);
  }

  // Returns that of the coarser grid, if there is one.
  std::optional<Viscosity> update(const Viscosity& mu) {
    if (stencil) {
      stencil->update(viscous_problem(grid, mu));
    } else {
      stencil = std::make_unique<Stencil>(viscous_problem(grid, mu));
    }
    set_diagonal(CoefficientView(grid, mu));
    if (!average_) return {};
    if (mu.is_constant()) return mu;
    average_->apply(mu.field().points(), coarse_viscosity_->points());
    extend_to_ghosts(*coarse_viscosity_);
    return Viscosity(coarse_viscosity_);
  }

  void smooth_from_zero(ConstBlocks b) {
    set_zero(x.unknowns());
    add_scaled(b);
  }
  void smooth(ConstBlocks b) {
    set_residual(b);
    add_scaled(std::as_const(residual).unknowns());
  }

  void set_residual(ConstBlocks b) {
    stencil->apply(x, residual.unknowns());
    scale_and_add(-1.0, b, residual.unknowns());
  }

  Grid grid;
  std::unique_ptr<Stencil> stencil;
  GhostedBlocks x, rhs, residual;
  std::vector<TensorMap> to_coarse, from_coarse;  // of each component

 private:
  void set_diagonal(ConstView mu) {
    const Blocks inverse = inverse_diagonal_.unknowns();
    for (int c = 0; c < 3; ++c) {
      const int j_first = first_unknown(grid, face_centrings[c], 1);
      const int k_first = first_unknown(grid, face_centrings[c], 2);
      const int i_first = first_unknown(grid, face_centrings[c], 0);
      const View view = inverse[c];
      for_each_plane(view.extent, [&](int k) {
        for (int j = 0; j < view.extent[1]; ++j) {
          double* row = view.row(j, k);
          stress_diagonal_row(grid, mu, c, j + j_first, k + k_first, row - i_first);
          for (int i = 0; i < view.extent[0]; ++i) row[i] = 1.0 / row[i];
        }
      });
    }
  }

  // x += damping D^-1 r.
  void add_scaled(ConstBlocks r) {
    const ConstBlocks inverse = std::as_const(inverse_diagonal_).unknowns();
    for (int c = 0; c < 3; ++c) {
      const View view = x.unknowns()[c];
      for_each_plane(view.extent, [&](int k) {
        for (int j = 0; j < view.extent[1]; ++j) {
          double* to = view.row(j, k);
          const double* from = r[c].row(j, k);
          const double* scale = inverse[c].row(j, k);
#pragma omp simd
          for (int i = 0; i < view.extent[0]; ++i) to[i] += damping * scale[i] * from[i];
        }
      });
    }
  }

  GhostedBlocks inverse_diagonal_;
  std::optional<TensorMap> average_;
  std::shared_ptr<Field<Cell>> coarse_viscosity_;
};

VelocityMultigrid::VelocityMultigrid(const Grid& grid) {
  levels_.push_back(std::make_unique<Level>(grid));
  for (Grid coarse = coarsened(grid); !(coarse == levels_.back()->grid); coarse = coarsened(coarse)) {
    levels_.back()->connect(coarse);
    levels_.push_back(std::make_unique<Level>(coarse));
  }
  coarsest_direction_ = std::make_unique<GhostedBlocks>(viscous_problem(levels_.back()->grid, 1.0));
  coarsest_solver_ =
      make_elliptic_solver(viscous_problem(levels_.back()->grid, 1.0).with_constant_viscosity(1.0), FftOptions{});
  update(1.0);
}

VelocityMultigrid::~VelocityMultigrid() = default;

void VelocityMultigrid::update(const Viscosity& mu) {
  std::optional<Viscosity> viscosity = mu;
  for (const auto& level : levels_) {
    coarsest_range_ = viscosity->checked_range();
    viscosity = level->update(*viscosity);
  }
  coarsest_solver_->update(coarsest_solver_->problem());
}

const Stencil& VelocityMultigrid::viscous_operator() const {
  return *levels_.front()->stencil;
}

void VelocityMultigrid::apply(ConstBlocks b, Blocks x) {
  cycle(0, b);
  copy(std::as_const(levels_.front()->x).unknowns(), x);
}

void VelocityMultigrid::cycle(std::size_t l, ConstBlocks b) {
  if (l + 1 == levels_.size()) {
    solve_coarsest(b);
    return;
  }
  Level& level = *levels_[l];
  Level& coarse = *levels_[l + 1];
  level.smooth_from_zero(b);
  level.set_residual(b);
  for (int c = 0; c < 3; ++c) level.to_coarse[c].apply(level.residual.unknowns()[c], coarse.rhs.unknowns()[c]);
  cycle(l + 1, std::as_const(coarse.rhs).unknowns());
  for (int c = 0; c < 3; ++c) level.from_coarse[c].add(coarse.x.unknowns()[c], level.x.unknowns()[c]);
  level.smooth(b);
}

// -Lap has eigenvalues relative to the viscous operator between the smallest and twice the largest viscosity:
// 2 |D|^2 = |grad u|^2 + (div u)^2 in the mean over the box, and 2 |D|^2 <= 2 |grad u|^2 at each point.
void VelocityMultigrid::solve_coarsest(ConstBlocks b) {
  Level& level = *levels_.back();
  ChebyshevSteps chebyshev(coarsest_range_.min, 2.0 * coarsest_range_.max);
  const int steps = chebyshev.steps(coarsest_reduction);
  set_zero(level.x.unknowns());
  for (int step = 0; step < steps; ++step) {
    const auto [from_d, from_r] = chebyshev.next();
    level.set_residual(b);
    coarsest_solver_->solve(level.residual.unknowns(), level.residual.unknowns());
    const Blocks d = coarsest_direction_->unknowns();
    const ConstBlocks z = std::as_const(level.residual).unknowns();
    for_each_row(z, d, [a = from_d, b_ = from_r](double* to, const double* from, int n) {
      for (int i = 0; i < n; ++i) to[i] = a * to[i] + b_ * from[i];
    });
    add(1.0, d, level.x.unknowns());
  }
}

}  // namespace vesiflow::fluid
