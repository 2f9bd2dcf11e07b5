// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/stokes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "grid/check_grid.h"
#include "message.h"
#include "operators/step_passes.h"
#include "stokes/bramble_pasciak_solver.h"
#include "stokes/saddle_vector.h"
#include "stokes/schur_complement_solver.h"
#include "stokes/stokes_operator.h"

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
  StokesReport solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p,
                     const Vector3& uniform_force, const Field<Cell>* source);

  Grid grid;
  StokesOptions options;

 private:
  std::array<double, 3> set_residual(const FaceVector& force, const Vector3& uniform_force, const FaceVector& u,
                                     ConstView p, const Field<Cell>* source);
  double velocity_residual_norm() { return std::sqrt(sums_.dot(residual_.u(), residual_.u())); }
  void remove_divergence(const WallVelocity& walls, const Field<Cell>* source, FaceVector& u, Field<Cell>& p);

  SaddleVector residual_, correction_;
  FaceVector lift_;  // zero but on walls and their ghosts
  Field<Cell> chi_;
  PlaneSums sums_;
  std::unique_ptr<EllipticSolver> pressure_solver_;
  std::optional<CoefficientView> mu_;
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
      chi_(grid_),
      sums_(grid_.cells[2] + 1),
      pressure_solver_(make_elliptic_solver(EllipticProblem::pressure(grid_), FftOptions{})) {
  update(1.0);
}

void StokesSolver::System::update(const Viscosity& mu) {
  if (!mu.is_constant()) check_grid("stokes", "the viscosity", mu.field(), grid);
  mu.checked_range();
  if (mu.is_constant()) {
    if (!constant_) constant_ = std::make_unique<SchurComplementSolver>(grid, mu.value());
    constant_->update(mu.value());
    solver_ = constant_.get();
    variable_.reset();
  } else {
    if (!variable_) variable_ = std::make_unique<BramblePasciakSolver>(grid);
    variable_->update(mu);
    solver_ = variable_.get();
    constant_.reset();
  }
  pressure_solver_->update(EllipticProblem::pressure(grid));
  mu_.emplace(grid, mu);
}

// r_u = f - A u - grad p and r_p = div u - source, of a velocity with its walls and ghosts set. Returns the means that f loses.
std::array<double, 3> StokesSolver::System::set_residual(const FaceVector& force, const Vector3& uniform_force,
                                                         const FaceVector& u, ConstView p, const Field<Cell>* source) {
  copy(p, correction_.p());
  solver_->viscous_operator().apply_to_points(u.points(), residual_.u());
  add_gradient(grid, correction_.pressure, residual_.u());
  scale_and_add(-1.0, force.unknowns(), residual_.u());
  for (int component = 0; component < 3; ++component) add_constant(uniform_force[component], residual_.u()[component]);
  negative_divergence(grid, u.points(), residual_.p());
  scale(-1.0, residual_.p());
  if (source != nullptr) add(-1.0, source->unknowns(), residual_.p());
  return grid.has_walls() ? std::array<double, 3>{} : sums_.remove_means(residual_.u());
}

// u -= grad phi with Lap phi = div u - source. Where mu is constant A grad phi = -grad(2 mu div u), half of it for the laplacian
// form: taken from the pressure, that keeps the velocity equation as it was, but for walls and changes of mu.
void StokesSolver::System::remove_divergence(const WallVelocity& walls, const Field<Cell>* source, FaceVector& u,
                                             Field<Cell>& p) {
  walls.set_normal_faces(u);
  divergence(u, chi_);
  if (source != nullptr) add(-1.0, source->unknowns(), chi_.unknowns());
  pressure_solver_->solve(chi_.unknowns(), chi_.unknowns());
  correct_velocity_and_pressure(chi_, 0.0, *mu_, constant_ ? 1.0 : 2.0, u, p);
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  sums_.remove_means(p.unknowns());
}

StokesReport StokesSolver::System::solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u,
                                         Field<Cell>& p, const Vector3& uniform_force, const Field<Cell>* source) {
  const auto start = std::chrono::steady_clock::now();
  check_grid("stokes", "the force", force, grid);
  check_grid("stokes", "the velocity", u, grid);
  check_grid("stokes", "the pressure", p, grid);
  if (source != nullptr) check_grid("stokes", "the source of the divergence", *source, grid);
  StokesReport report;
  walls.set_normal_faces(lift_);
  walls.fill_ghosts(lift_);
  set_zero(chi_.unknowns());
  report.removed_mean_force = set_residual(force, uniform_force, lift_, std::as_const(chi_).unknowns(), source);
  const double force_norm = velocity_residual_norm();
  if (!std::isfinite(force_norm)) throw std::runtime_error("stokes: the force is not finite");
  const double size = solver_->norm(residual_);
  const auto relative_to = [](double whole, double part) { return whole > 0.0 ? part / whole : part; };

  if (size == 0.0) {  // nothing moves, whatever the guess
    set_zero(u.unknowns());
    set_zero(p.unknowns());
  }
  if (!grid.has_walls()) sums_.remove_means(u.unknowns());
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  set_residual(force, uniform_force, u, p.unknowns(), source);
  if (!std::isfinite(velocity_residual_norm())) throw std::runtime_error("stokes: the initial guess is not finite");
  // No further below the residual of the guess than round-off allows.
  const double target = std::max(options.tolerance * size, 1e-13 * solver_->norm(residual_));
  const SaddleProgress progress = solver_->solve(residual_, target, options.max_iterations, correction_);
  report.iterations = progress.iterations;
  report.converged = progress.norm <= target;
  add(1.0, correction_.u(), u.unknowns());
  add(1.0, correction_.p(), p.unknowns());
  if (!grid.has_walls()) sums_.remove_means(u.unknowns());
  remove_divergence(walls, source, u, p);

  set_residual(force, uniform_force, u, p.unknowns(), source);
  report.momentum_residual = relative_to(force_norm, velocity_residual_norm());
  report.residual = relative_to(size, solver_->norm(residual_));
  report.divergence = max_divergence(u, source);
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

StokesReport StokesSolver::solve(const FaceVector& force, const WallVelocity& walls, FaceVector& u, Field<Cell>& p,
                                 const Vector3& uniform_force, const Field<Cell>* source) {
  return system_->solve(force, walls, u, p, uniform_force, source);
}

const Grid& StokesSolver::grid() const {
  return system_->grid;
}
const StokesOptions& StokesSolver::options() const {
  return system_->options;
}

// Arrays of one number per cell: residual_, correction_ (4 each), lift_ and chi_; two saddle vectors, or four, A p and the
// multigrid's four vectors on all levels.
std::size_t StokesSolver::estimate_memory(const Grid& grid, const Viscosity& mu) {
  const double fields = 12.0 + (!mu.is_constant() ? 19.0 + 12.0 * 8.0 / 7.0 : 8.0);
  double points = 1.0;
  for (const int cells : grid.cells) points *= cells + 2.5;  // ghosts, and the last faces of one component in three
  std::size_t bytes = static_cast<std::size_t>(sizeof(double) * fields * points);
  bytes += estimate_solver_memory(EllipticProblem::pressure(grid), FftOptions{});
  if (!mu.is_constant()) return bytes;
  return bytes +
         estimate_solver_memory(EllipticProblem::velocity(grid, EllipticForm::laplacian, 0.0, 1.0), FftOptions{});
}

}  // namespace vesiflow::fluid
