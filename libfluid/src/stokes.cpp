#include "fluid/stokes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "bramble_pasciak_solver.h"
#include "fluid/operators.h"
#include "message.h"
#include "saddle_vector.h"
#include "schur_complement_solver.h"
#include "stokes_operator.h"

namespace vesiflow::fluid {
namespace {

const StokesOptions& checked(const StokesOptions& options) {
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0)) {
    throw std::invalid_argument(
        message("stokes: the tolerance is ", options.tolerance, "; it must be between 0 and 1"));
  }
  if (options.max_iterations < 1) {
    throw std::invalid_argument(
        message("stokes: max_iterations is ", options.max_iterations, "; it must be at least 1"));
  }
  return options;
}

}  // namespace

class StokesSolver::System {
 public:
  System(const Grid& grid, const StokesOptions& options);
  void update(const Viscosity& mu);
  StokesReport solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p);

  Grid grid;
  StokesOptions options;

 private:
  void set_residual(const FaceVector& force, const FaceVector& u, GhostedBlocks& p);

  SaddleVector residual_, correction_;
  FaceVector lift_;  // zero but on walls and their ghosts
  PlaneSums sums_;
  // The one that suits the viscosity; the other is released.
  std::unique_ptr<SchurComplementSolver> constant_;
  std::unique_ptr<BramblePasciakSolver> variable_;
  SaddleSolver* solver_ = nullptr;
};

StokesSolver::System::System(const Grid& grid_, const StokesOptions& options_)
    : grid(grid_),
      options(checked(options_)),
      residual_(grid_),
      correction_(grid_),
      lift_(grid_),
      sums_(grid_.cells[2] + 1) {
  update(1.0);
}

void StokesSolver::System::update(const Viscosity& mu) {
  if (!mu.is_constant() && !(mu.field().grid() == grid)) {
    throw std::invalid_argument("stokes: the viscosity is on another grid");
  }
  mu.checked_range();
  if (mu.is_constant()) {
    variable_.reset();
    if (!constant_) constant_ = std::make_unique<SchurComplementSolver>(grid, mu.value());
    constant_->update(mu.value());
    solver_ = constant_.get();
  } else {
    constant_.reset();
    if (!variable_) variable_ = std::make_unique<BramblePasciakSolver>(grid);
    variable_->update(mu);
    solver_ = variable_.get();
  }
}

// r_u = f - A u - grad p and r_p = div u, of a velocity with its walls and ghosts set.
void StokesSolver::System::set_residual(const FaceVector& force, const FaceVector& u, GhostedBlocks& p) {
  solver_->viscous_operator().apply_to_points(u.points(), residual_.u());
  add_gradient(grid, p, residual_.u());
  scale_and_add(-1.0, force.unknowns(), residual_.u());
  negative_divergence(grid, u.points(), residual_.p());
  scale(-1.0, residual_.p());
}

StokesReport StokesSolver::System::solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u,
                                         Field<Cell>& p) {
  const auto start = std::chrono::steady_clock::now();
  if (!(force.grid() == grid && u.grid() == grid && p.grid() == grid)) {
    throw std::invalid_argument("stokes: the force, the velocity or the pressure is on another grid");
  }
  StokesReport report;
  walls.set_normal_faces(lift_);
  walls.fill_ghosts(lift_);
  set_zero(correction_.p());
  set_residual(force, lift_, correction_.pressure);
  if (!grid.has_walls()) report.removed_mean_force = sums_.remove_means(residual_.u());
  const double size = solver_->norm(residual_);
  const double force_norm = std::sqrt(sums_.dot(residual_.u(), residual_.u()));
  if (!std::isfinite(size)) throw std::runtime_error("stokes: the force is not finite");

  if (!grid.has_walls()) sums_.remove_means(u.unknowns());
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  copy(p.unknowns(), correction_.p());
  set_residual(force, u, correction_.pressure);
  if (!grid.has_walls()) sums_.remove_means(residual_.u());
  const SaddleProgress progress =
      solver_->solve(residual_, options.tolerance * size, options.max_iterations, correction_);
  if (!std::isfinite(progress.norm)) throw std::runtime_error("stokes: the initial guess is not finite");
  add(1.0, correction_.u(), u.unknowns());
  add(1.0, correction_.p(), p.unknowns());
  sums_.remove_means(p.unknowns());
  if (!grid.has_walls()) sums_.remove_means(u.unknowns());
  walls.fill_ghosts(u);

  copy(p.unknowns(), correction_.p());
  set_residual(force, u, correction_.pressure);
  if (!grid.has_walls()) sums_.remove_means(residual_.u());
  report.iterations = progress.iterations;
  report.converged = progress.norm <= options.tolerance * size;
  report.residual = size > 0.0 ? progress.norm / size : progress.norm;
  report.momentum_residual = std::sqrt(sums_.dot(residual_.u(), residual_.u()));
  if (force_norm > 0.0) report.momentum_residual /= force_norm;
  report.divergence = max_divergence(u);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

StokesSolver::StokesSolver(const Grid& grid, const StokesOptions& options)
    : system_(std::make_unique<System>(grid, options)) {}
StokesSolver::~StokesSolver() = default;
StokesSolver::StokesSolver(StokesSolver&&) noexcept = default;
StokesSolver& StokesSolver::operator=(StokesSolver&&) noexcept = default;

void StokesSolver::update(const Viscosity& mu) {
  system_->update(mu);
}

StokesReport StokesSolver::solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p) {
  return system_->solve(force, walls, u, p);
}

const Grid& StokesSolver::grid() const {
  return system_->grid;
}
const StokesOptions& StokesSolver::options() const {
  return system_->options;
}

}  // namespace vesiflow::fluid
