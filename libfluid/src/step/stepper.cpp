// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/stepper.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "grid/check_grid.h"
#include "grid/planes.h"
#include "message.h"
#include "operators/block_algebra.h"
#include "phase_timer.h"

namespace vesiflow::fluid {
namespace {

void check_viscosity(const Grid& grid, const Viscosity& viscosity) {
  if (!viscosity.is_constant()) check_grid("fluid", "the field of viscosity", viscosity.field(), grid);
}

void check_memory(const Grid& grid, const FluidParameters& parameters) {
  const double bytes = static_cast<double>(NavierStokes::estimate_memory(grid, parameters));
  const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes <= physical) return;
  throw std::invalid_argument(message("fluid: ", grid.cells[0], " x ", grid.cells[1], " x ", grid.cells[2],
                                      " cells would take about ", bytes / 1e9, " GB, this machine has ", physical / 1e9,
                                      " GB; use fewer cells"));
}

void check_precision(const FluidParameters& parameters) {
  if (parameters.precision == Precision::double_) return;
  if (parameters.inertia == Inertia::none) {
    throw std::invalid_argument(
        "fluid: the precision is mixed and there is no inertia; mixed is of steps with inertia, take double");
  }
}

FluidParameters checked(const Grid& grid, const FluidParameters& parameters) {
  const double re = parameters.reynolds_number;
  if (!(std::isfinite(re) && re > 0.0)) {
    throw std::invalid_argument(message("fluid: reynolds_number is ", re, "; it must be finite and > 0"));
  }
  check_precision(parameters);
  parameters.viscosity.checked_range();
  check_viscosity(grid, parameters.viscosity);
  check_memory(grid, parameters);
  return parameters;
}

void check_converged(const char* what, const SolveReport& report) {
  if (report.converged) return;
  throw std::runtime_error(message("the ", what, " solver stopped after ", report.iterations,
                                   " iterations at a relative residual of ", report.residual.value_or(0.0)));
}

template <class FieldType>
void copy(const FieldType& from, FieldType& to) {
  std::copy_n(from.data(), from.size(), to.data());
}

void copy(const FaceVector& from, FaceVector& to) {
  copy(from.x, to.x);
  copy(from.y, to.y);
  copy(from.z, to.z);
}

double max_abs(const FaceVector& u) {
  double largest = 0.0;
  for (const ConstView& field : u.points()) {
    for (int k = 0; k < field.extent[2]; ++k) {
      for (int j = 0; j < field.extent[1]; ++j) {
        for (int i = 0; i < field.extent[0]; ++i) largest = std::max(largest, magnitude(field(i, j, k)));
      }
    }
  }
  return largest;
}

bool is_finite(ConstView field) {
  return std::isfinite(max_over_planes(field.extent, [&](int k) {
    double largest = 0.0;
    for (int j = 0; j < field.extent[1]; ++j) {
      for (int i = 0; i < field.extent[0]; ++i) largest = std::max(largest, magnitude(field(i, j, k)));
    }
    return largest;
  }));
}

double mean(ConstView values) {
  const auto [nx, ny, nz] = values.extent;
  double sum = 0.0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) sum += values(i, j, k);
  return sum / (static_cast<double>(nx) * ny * nz);
}

void subtract(double constant, Field<Cell>& field) {
  const View values = field.points();
  const auto [nx, ny, nz] = values.extent;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) values(i, j, k) -= constant;
}

bool is_finite(const FaceVector& u) {
  return is_finite(u.x.unknowns()) && is_finite(u.y.unknowns()) && is_finite(u.z.unknowns());
}

}  // namespace

SolverOptions in_precision(Precision precision, const EllipticProblem& problem, SolverOptions options) {
  if (precision == Precision::double_) return options;
  if (const auto* automatic = std::get_if<AutoOptions>(&options)) options = choose_solver(problem, *automatic).options;
  auto* fft = std::get_if<FftOptions>(&options);
  if (auto* pcg = std::get_if<PcgOptions>(&options)) fft = std::get_if<FftOptions>(&pcg->preconditioner);
  if (fft != nullptr) fft->arithmetic = FftOptions::Arithmetic::single;
  return options;
}

EllipticProblem momentum_problem(const Grid& grid, const FluidParameters& parameters, double a, double mu_reference) {
  const bool coupled =
      !parameters.viscosity.is_constant() && parameters.viscous_treatment == ViscousTreatment::implicit;
  if (coupled) return EllipticProblem::velocity(grid, EllipticForm::stress, a, parameters.viscosity);
  return EllipticProblem::velocity(grid, EllipticForm::laplacian, a, mu_reference);
}

Stepper::Stepper(const Grid& grid_, const FluidParameters& parameters_, BoundaryVelocity boundary, WallMotion motion)
    : grid(grid_),
      parameters(checked(grid_, parameters_)),
      walls(grid_, std::move(boundary), motion),
      velocity(grid_),
      previous(grid_),
      force(grid_),
      pressure(grid_),
      pressure_solver(make_elliptic_solver(EllipticProblem::pressure(grid_), parameters_.pressure_solver)),
      unit_(grid_, 1.0),
      viscosity_(grid_, parameters.viscosity),
      chi_(grid_) {
  if (parameters.inertia == Inertia::full) convection_.emplace(grid);
  if (parameters.inertia == Inertia::none) {
    stokes_.emplace(grid, parameters.stokes);
    stokes_->update(parameters.viscosity);
    start();
    return;
  }
  const bool explicit_stress = parameters.viscous_treatment == ViscousTreatment::explicit_;
  if (variable_viscosity() && !explicit_stress) extrapolated_.emplace(grid);
  if (implicit_stress()) {
    lift_.emplace(grid);
    walls.set_normal_faces(*lift_);
    walls.fill_ghosts(*lift_);
  }
  start();
}

// From the inner velocity, whatever it is, to a state at time zero.
void Stepper::start() {
  clock = {};
  is_remembered_ = false;
  pressure.fill(0.0);
  if (convection_) convection_->fill(0.0);  // not used by the first step, but read
  walls.evaluate(0.0);
  walls.set_normal_faces(velocity);
  make_divergence_free();
  walls.set_normal_faces(velocity);
  walls.fill_ghosts(velocity);
  copy(velocity, previous);
  believe_divergence();
}

// Of a velocity that no step has led to.
void Stepper::believe_divergence() {
  if (given_divergence) divergence(velocity, *given_divergence);
}

void Stepper::make_divergence_free() {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * max_abs(velocity) / grid.min_spacing();
  if (max_divergence(velocity) <= round_off) return;
  divergence(velocity, chi_);
  check_converged("pressure", pressure_solver->solve(chi_.unknowns(), chi_.unknowns()));
  remove_divergence(chi_, velocity);
}

namespace {

// visit(component, i, j, k, position) at all points of all components.
template <typename Visit>
void for_each_point(const Grid& grid, Visit visit) {
  for (int component = 0; component < 3; ++component) {
    const auto n = point_extent(grid, face_centrings[component]);
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          visit(component, i, j, k, point_position(grid, face_centrings[component], i, j, k));
  }
}

}  // namespace

// Looks at all values before it changes any: a second velocity to sample into would be the peak of a run's memory.
void Stepper::set_velocity(const std::function<Vector3(const Vector3&)>& function) {
  for_each_point(grid, [&](int component, int, int, int, const Vector3& r) {
    const double value = function(r)[component];
    if (std::isfinite(value)) return;
    throw std::invalid_argument(message("fluid: the velocity to start from is ", value, " in component ", component,
                                        " at (", r[0], ", ", r[1], ", ", r[2], ")"));
  });
  velocity.fill(0.0);
  const auto fields = velocity.points();
  for_each_point(grid, [&](int component, int i, int j, int k, const Vector3& r) {
    fields[component](i, j, k) = function(r)[component];
  });
  start();
}

void Stepper::start_from(const FaceVector& velocity_, const Field<Cell>& pressure_) {
  check_grid("fluid", "the velocity to start from", velocity_, grid);
  check_grid("fluid", "the pressure to start from", pressure_, grid);
  if (!(is_finite(velocity_) && is_finite(pressure_.points())))
    throw std::invalid_argument("fluid: the fields to start from are not finite");
  copy(velocity_, velocity);
  start();
  copy(pressure_, pressure);
  subtract(mean(std::as_const(pressure).points()), pressure);
  extend_to_ghosts(pressure);
}

void Stepper::restore(const FaceVector& velocity_, const FaceVector& previous_, const Field<Cell>& pressure_,
                      const FluidClock& clock_) {
  check_grid("fluid", "the velocity to restore", velocity_, grid);
  check_grid("fluid", "the previous velocity to restore", previous_, grid);
  check_grid("fluid", "the pressure to restore", pressure_, grid);
  // The last step is the time between, but for round-off in long times.
  const double between = clock_.time - clock_.previous_time;
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(clock_.time);
  if (clock_.steps < 0 || !std::isfinite(clock_.time) || !std::isfinite(clock_.previous_time) ||
      (clock_.steps > 0 &&
       !(clock_.time_step > round_off && std::abs(between - clock_.time_step) <= round_off + 1e-9 * between))) {
    throw std::invalid_argument(
        message("fluid: the state to restore has time ", clock_.time, ", previous time ", clock_.previous_time,
                ", time step ", clock_.time_step, " and step number ", clock_.steps,
                "; they must be finite, in order, and the time step positive and the time between"));
  }
  if (!(is_finite(velocity_) && is_finite(previous_) && is_finite(pressure_.points()))) {
    throw std::invalid_argument("fluid: the state to restore is not finite");
  }
  walls.evaluate(clock_.previous_time);  // refuses what it has to before anything is changed
  walls.evaluate(clock_.time);
  clock = clock_;
  is_remembered_ = false;
  if (driven_) driven_->step = -1;
  copy(velocity_, velocity);
  copy(previous_, previous);
  copy(pressure_, pressure);
  extend_to_ghosts(pressure);
  walls.evaluate(clock.previous_time);
  walls.set_normal_faces(previous);
  walls.fill_ghosts(previous);
  recompute_convection();
  walls.evaluate(clock.time);
  walls.set_normal_faces(velocity);
  walls.fill_ghosts(velocity);
  believe_divergence();
}

// From the previous velocity, walls and ghosts included.
void Stepper::recompute_convection() {
  if (convection_ && clock.steps > 0) {
    convection(previous, *convection_);
  } else if (convection_) {
    convection_->fill(0.0);
  }
}

void Stepper::remember() {
  if (!remembered_) remembered_.emplace(Remembered{FaceVector(grid), Field<Cell>(grid), {}});
  copy(previous, remembered_->previous);
  copy(pressure, remembered_->pressure);
  remembered_->clock = clock;
  is_remembered_ = true;
}

void Stepper::forget() {
  remembered_.reset();
  is_remembered_ = false;
}

void Stepper::retry() {
  if (!is_remembered_ || clock.steps > remembered_->clock.steps + 1) {
    throw std::logic_error("fluid: retry() goes back by one step at most, to a state that remember() was called at");
  }
  if (clock.steps > remembered_->clock.steps) std::swap(velocity, previous);
  copy(remembered_->previous, previous);
  copy(remembered_->pressure, pressure);
  clock = remembered_->clock;
  recompute_convection();
  walls.evaluate(clock.time);
  believe_divergence();
}

// Others may have moved other fields into these.
void Stepper::check_given() {
  check_grid("fluid", "the force", force, grid);
  if (!source) return;
  check_grid("fluid", "the source of the divergence", *source, grid);
  source_mean_ = mean(std::as_const(*source).points());
}

// What div u is to be, of a flow without inertia: in a step with inertia a pass for the pressure does it.
void Stepper::give_divergence() {
  if (!source) return;
  copy(*source, *given_divergence);
  subtract(source_mean_, *given_divergence);
}

void Stepper::keep_force() {
  if (!stokes_ && !driven_)
    driven_.emplace(
        Driven{FaceVector(grid), {}, -1, WallVelocity(grid, [](const Vector3&, double) { return Vector3{}; })});
}

void Stepper::solve_again() {
  if (clock.steps == 0 || (!stokes_ && !(driven_ && driven_->step == clock.steps)))
    throw std::logic_error("fluid: solve_again() is after a step and, with inertia, one after keep_force()");
  if (variable_viscosity() && !stokes_) throw std::logic_error("fluid: solve_again() with inertia is of one viscosity");
  check_given();
  try {
    if (stokes_) {
      solve_stokes(velocity);
    } else {
      add_change();
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        message("fluid: step ", clock.steps, " to time ", clock.time, " solved again failed: ", error.what()));
  }
}

// The step is linear in the force and in the source of the divergence: of these only the change is solved for, which has no history, no
// convection and walls at rest.
void Stepper::add_change() {
  FaceVector& change = driven_->force;
  {
    const PhaseTimer timer(timings.momentum);
    const Blocks right_side = change.unknowns();
    scale_and_add(-1.0, std::as_const(force).unknowns(), right_side);
    for (int axis = 0; axis < 3; ++axis)
      if (const double more = uniform_force[axis] - driven_->uniform_force[axis]; more != 0.0)
        add_constant(more, right_side[axis]);
    report.momentum = velocity_solver->solve(std::as_const(change).unknowns(), change.unknowns());
    check_converged("velocity", report.momentum);
  }
  {
    const PhaseTimer timer(timings.projection);
    driven_->at_rest.set_normal_faces(change);
    if (source) {
      change_of_divergence_beyond(change, *source, source_mean_, *given_divergence, chi_);
    } else {
      divergence(change, chi_);
    }
    solve_pressure();
    add_corrected_increment(chi_, velocity_solver->problem().alpha, unit_, reference_viscosity_, force, change,
                            velocity, pressure);
    finish(velocity);
  }
  driven_->uniform_force = uniform_force;
}

void Stepper::step(double dt) {
  if (!(std::isfinite(dt) && dt > 0.0)) {
    throw std::invalid_argument(message("fluid: the time step is ", dt, "; it must be finite and > 0"));
  }
  check_given();
  walls.evaluate(clock.time + dt);
  try {
    if (stokes_) {
      extrapolate_and_solve_stokes(dt);
    } else {
      advance_with_inertia(dt);
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(message("fluid: step ", clock.steps + 1, " to time ", clock.time + dt, " with time step ",
                                     dt, " failed: ", error.what()));
  }
  std::swap(velocity, previous);
  clock = {clock.time + dt, clock.time, dt, clock.steps + 1};
}

void Stepper::advance_with_inertia(double dt) {
  const StepCoefficients coefficients = step_coefficients(dt, previous_step());
  const double a = parameters.reynolds_number * coefficients.a0 / dt;
  update_velocity_solver(a);
  form_right_hand_side(coefficients, dt);
  if (driven_) {
    driven_->uniform_force = uniform_force;
    driven_->step = clock.steps + 1;
  }
  if (variable_viscosity()) add_explicit_stress();
  solve_momentum();
  {
    const PhaseTimer timer(timings.projection);
    walls.set_normal_faces(previous);
    if (source) {
      divergence_beyond(previous, *source, source_mean_, *given_divergence, chi_);
    } else {
      divergence(previous, chi_);
    }
    solve_pressure();
    if (implicit_stress()) {
      correct_velocity_and_pressure(chi_, a, viscosity_, 1.0, previous, pressure);
    } else {
      correct_velocity_and_pressure(chi_, a, unit_, reference_viscosity_, previous, pressure);
    }
    finish(previous);
  }
}

void Stepper::extrapolate_and_solve_stokes(double dt) {
  if (variable_viscosity()) {
    const PhaseTimer timer(timings.viscous);
    stokes_->update(parameters.viscosity);
  }
  const double r = step_coefficients(dt, previous_step()).b2;
  extrapolate(velocity, previous, r, previous);
  solve_stokes(previous);
}

void Stepper::solve_stokes(FaceVector& solution) {
  const PhaseTimer timer(timings.momentum);
  give_divergence();
  report.stokes =
      stokes_->solve(force, walls, solution, pressure, uniform_force, given_divergence ? &*given_divergence : nullptr);
  if (!report.stokes.converged) {
    throw std::runtime_error(message("the Stokes solver stopped after ", report.stokes.iterations,
                                     " iterations at a relative residual of ", report.stokes.residual));
  }
  extend_to_ghosts(pressure);
}

void Stepper::update_velocity_solver(double a) {
  if (velocity_solver && !variable_viscosity() && velocity_solver->problem().alpha == a) return;
  const PhaseTimer timer(variable_viscosity() ? timings.viscous : timings.momentum);
  reference_viscosity_ = parameters.viscosity.checked_range().max;
  if (variable_viscosity()) {
    // Looked at anew, as its owner may have moved another field into it.
    check_viscosity(grid, parameters.viscosity);
    viscosity_.set(grid, parameters.viscosity);
  }
  const EllipticProblem problem = momentum_problem(grid, parameters, a, reference_viscosity_);
  if (velocity_solver) {
    velocity_solver->update(problem);
  } else {
    velocity_solver =
        make_elliptic_solver(problem, in_precision(parameters.precision, problem, parameters.velocity_solver));
  }
}

// The arrays of the previous velocity take the right-hand side, the provisional and at last the new velocity.
void Stepper::form_right_hand_side(const StepCoefficients& coefficients, double dt) {
  if (extrapolated_) {
    const PhaseTimer timer(timings.viscous);
    extrapolate(velocity, previous, coefficients.b2, *extrapolated_);
  }
  const PhaseTimer timer(timings.convection);
  explicit_terms(coefficients, parameters.reynolds_number, dt, velocity, pressure, force, uniform_force,
                 convection_ ? &*convection_ : nullptr, previous, driven_ ? &driven_->force : nullptr,
                 solves_for_change()
                     ? std::optional(MomentumOperator{velocity_solver->problem().alpha, reference_viscosity_})
                     : std::nullopt);
  if (solves_for_change()) {
    walls.add_diffusion_of_change(reference_viscosity_, previous);
  } else if (!implicit_stress()) {
    walls.add_diffusion(reference_viscosity_, previous);
  }
}

// What the operator of the velocity problem leaves out of div(mu (grad u + grad u^T)).
void Stepper::add_explicit_stress() {
  const PhaseTimer timer(timings.viscous);
  if (implicit_stress()) {
    if (!walls.steady()) {
      walls.set_normal_faces(*lift_);
      walls.fill_ghosts(*lift_);
    }
    add_stress(*lift_, viscosity_, 0.0, previous);
  } else {
    add_stress(extrapolated_ ? *extrapolated_ : velocity, viscosity_, reference_viscosity_, previous);
  }
}

void Stepper::solve_momentum() {
  const PhaseTimer timer(timings.momentum);
  if (implicit_stress()) {
    report.momentum = velocity_solver->solve(std::as_const(previous).unknowns(), extrapolated_->unknowns());
    std::swap(previous, *extrapolated_);
  } else if (solves_for_change()) {
    report.momentum = velocity_solver->add_solution(std::as_const(previous).unknowns(),
                                                    std::as_const(velocity).unknowns(), previous.unknowns());
  } else {
    report.momentum = velocity_solver->solve(std::as_const(previous).unknowns(), previous.unknowns());
  }
  check_converged("velocity", report.momentum);
}

// For the divergence that is too much.
void Stepper::solve_pressure() {
  report.pressure = pressure_solver->solve(std::as_const(chi_).unknowns(), chi_.unknowns());
  check_converged("pressure", report.pressure);
}

// What lies outside of the unknowns, at the end of a step.
void Stepper::finish(FaceVector& u) {
  extend_to_ghosts(pressure);
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
}

std::string Stepper::velocity_solver_name() const {
  if (stokes_) return "stokes";
  return velocity_solver ? velocity_solver->name() : "none before the first step";
}

}  // namespace vesiflow::fluid
