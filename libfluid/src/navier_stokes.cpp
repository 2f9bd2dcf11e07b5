#include "fluid/navier_stokes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "message.h"
#include "stencil.h"
#include "step_passes.h"

namespace vesiflow::fluid {
namespace {

// Adds the wall time of its life to an account.
class PhaseTimer {
 public:
  explicit PhaseTimer(double& seconds) : seconds_(seconds) {}
  ~PhaseTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

FluidParameters checked(const FluidParameters& parameters) {
  const auto check = [](const char* name, double value) {
    if (std::isfinite(value) && value > 0.0) return;
    throw std::invalid_argument(message("fluid: ", name, " is ", value, "; it must be finite and > 0"));
  };
  check("reynolds_number", parameters.reynolds_number);
  check("viscosity", parameters.viscosity);
  return parameters;
}

EllipticProblem velocity_problem(const Grid& grid, int component, double alpha, double mu) {
  return {grid, face_centrings[component], BoundaryCondition::dirichlet, alpha, mu};
}

EllipticProblem pressure_problem(const Grid& grid) {
  return {grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0};
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
        for (int i = 0; i < field.extent[0]; ++i) largest = std::max(largest, std::abs(field(i, j, k)));
      }
    }
  }
  return largest;
}

}  // namespace

class NavierStokes::Stepper {
 public:
  Stepper(const Grid& grid, const FluidParameters& parameters, BoundaryVelocity boundary, bool steady_boundary);

  void set_velocity(const std::function<Vector3(const Vector3&)>& function);
  void restore(const FaceVector& velocity, const FaceVector& previous_velocity, const Field<Cell>& pressure,
               const FluidClock& clock);
  void step(double dt);

  Grid grid;
  FluidParameters parameters;
  WallVelocity walls;
  FaceVector velocity, previous, force;
  Field<Cell> pressure;
  FluidClock clock;
  FluidTimings timings;

 private:
  void start();
  void make_divergence_free();
  void update_solvers(double alpha);
  void form_right_hand_side(const StepCoefficients& coefficients, double dt);
  void solve_momentum();
  void project(double a);

  std::optional<FaceVector> convection_;  // of the previous velocity
  Field<Cell> chi_;
  std::unique_ptr<EllipticSolver> pressure_solver_;
  std::array<std::unique_ptr<EllipticSolver>, 3> velocity_solvers_;
};

NavierStokes::Stepper::Stepper(const Grid& grid_, const FluidParameters& parameters_, BoundaryVelocity boundary,
                               bool steady_boundary)
    : grid(grid_),
      parameters(checked(parameters_)),
      walls(grid_, std::move(boundary), steady_boundary),
      velocity(grid_),
      previous(grid_),
      force(grid_),
      pressure(grid_),
      chi_(grid_),
      pressure_solver_(make_elliptic_solver(pressure_problem(grid_), parameters_.pressure_solver)) {
  if (parameters.convection) convection_.emplace(grid);
  start();
}

// From the inner velocity, whatever it is, to a state at time zero.
void NavierStokes::Stepper::start() {
  clock = {};
  pressure.fill(0.0);
  walls.evaluate(0.0);
  walls.set_normal_faces(velocity);
  make_divergence_free();
  walls.fill_ghosts(velocity);
  copy(velocity, previous);
}

void NavierStokes::Stepper::make_divergence_free() {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * max_abs(velocity) / grid.min_spacing();
  if (max_divergence(velocity) <= round_off) return;
  divergence(velocity, chi_);
  pressure_solver_->solve(chi_.unknowns(), chi_.unknowns());
  remove_divergence(chi_, velocity);
}

void NavierStokes::Stepper::set_velocity(const std::function<Vector3(const Vector3&)>& function) {
  const auto fields = velocity.points();
  for (int component = 0; component < 3; ++component) {
    const View& field = fields[component];
    for (int k = 0; k < field.extent[2]; ++k) {
      for (int j = 0; j < field.extent[1]; ++j) {
        for (int i = 0; i < field.extent[0]; ++i) {
          field(i, j, k) = function(point_position(grid, face_centrings[component], i, j, k))[component];
        }
      }
    }
  }
  start();
}

void NavierStokes::Stepper::restore(const FaceVector& velocity_, const FaceVector& previous_,
                                    const Field<Cell>& pressure_, const FluidClock& clock_) {
  if (!(velocity_.grid() == grid && previous_.grid() == grid && pressure_.grid() == grid)) {
    throw std::invalid_argument("fluid: the state to restore is on another grid");
  }
  if (clock_.steps < 0 || !std::isfinite(clock_.time) || !std::isfinite(clock_.previous_time) ||
      (clock_.steps > 0 && !(clock_.time_step > 0.0 && std::isfinite(clock_.time_step)))) {
    throw std::invalid_argument(message("fluid: the state to restore has time ", clock_.time, ", previous time ",
                                        clock_.previous_time, ", time step ", clock_.time_step, " and step number ",
                                        clock_.steps, "; they must be finite, and the time step positive"));
  }
  clock = clock_;
  copy(velocity_, velocity);
  copy(previous_, previous);
  copy(pressure_, pressure);
  walls.evaluate(clock.previous_time);
  walls.set_normal_faces(previous);
  walls.fill_ghosts(previous);
  if (convection_ && clock.steps > 0) convection(previous, *convection_);
  walls.evaluate(clock.time);
  walls.set_normal_faces(velocity);
  walls.fill_ghosts(velocity);
}

void NavierStokes::Stepper::step(double dt) {
  if (!(std::isfinite(dt) && dt > 0.0)) {
    throw std::invalid_argument(message("fluid: the time step is ", dt, "; it must be finite and > 0"));
  }
  const StepCoefficients coefficients = step_coefficients(dt, clock.steps > 0 ? clock.time_step : 0.0);
  const double a = parameters.reynolds_number * coefficients.a0 / dt;
  walls.evaluate(clock.time + dt);
  try {
    update_solvers(a);
    form_right_hand_side(coefficients, dt);
    solve_momentum();
    project(a);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(message("fluid: step ", clock.steps + 1, " to time ", clock.time + dt, " with time step ",
                                     dt, " failed: ", error.what()));
  }
  std::swap(velocity, previous);
  clock = {clock.time + dt, clock.time, dt, clock.steps + 1};
}

void NavierStokes::Stepper::update_solvers(double alpha) {
  for (int component = 0; component < 3; ++component) {
    const EllipticProblem problem = velocity_problem(grid, component, alpha, parameters.viscosity);
    auto& solver = velocity_solvers_[component];
    if (!solver) {
      solver = make_elliptic_solver(problem, parameters.velocity_solver);
    } else if (solver->problem().alpha != alpha) {
      solver->update(problem);
    }
  }
}

// The arrays of the previous velocity take the right-hand side, the provisional and at last the new velocity.
void NavierStokes::Stepper::form_right_hand_side(const StepCoefficients& coefficients, double dt) {
  const PhaseTimer timer(timings.convection);
  explicit_terms(coefficients, parameters.reynolds_number, dt, velocity, pressure, force,
                 convection_ ? &*convection_ : nullptr, previous);
  walls.add_diffusion(parameters.viscosity, previous);
}

void NavierStokes::Stepper::solve_momentum() {
  const PhaseTimer timer(timings.momentum);
  const auto unknowns = previous.unknowns();
  for (int component = 0; component < 3; ++component) {
    velocity_solvers_[component]->solve(unknowns[component], unknowns[component]);
  }
}

void NavierStokes::Stepper::project(double a) {
  const PhaseTimer timer(timings.projection);
  walls.set_normal_faces(previous);
  divergence(previous, chi_);
  pressure_solver_->solve(chi_.unknowns(), chi_.unknowns());
  correct_velocity_and_pressure(chi_, a, CoefficientView(grid, parameters.viscosity), 1.0, previous, pressure);
  walls.fill_ghosts(previous);
}

NavierStokes::NavierStokes(const Grid& grid, const FluidParameters& parameters, BoundaryVelocity boundary,
                           bool steady_boundary)
    : stepper_(std::make_unique<Stepper>(grid, parameters, std::move(boundary), steady_boundary)) {}

NavierStokes::~NavierStokes() = default;
NavierStokes::NavierStokes(NavierStokes&&) noexcept = default;
NavierStokes& NavierStokes::operator=(NavierStokes&&) noexcept = default;

void NavierStokes::set_velocity(const std::function<Vector3(const Vector3&)>& velocity) {
  stepper_->set_velocity(velocity);
}

void NavierStokes::restore(const FaceVector& velocity, const FaceVector& previous_velocity, const Field<Cell>& pressure,
                           const FluidClock& clock) {
  stepper_->restore(velocity, previous_velocity, pressure, clock);
}

void NavierStokes::step(double dt) {
  stepper_->step(dt);
}

FaceVector& NavierStokes::force() {
  return stepper_->force;
}
const FaceVector& NavierStokes::force() const {
  return stepper_->force;
}
const FaceVector& NavierStokes::velocity() const {
  return stepper_->velocity;
}
const FaceVector& NavierStokes::previous_velocity() const {
  return stepper_->previous;
}
const Field<Cell>& NavierStokes::pressure() const {
  return stepper_->pressure;
}
const FluidClock& NavierStokes::clock() const {
  return stepper_->clock;
}
const Grid& NavierStokes::grid() const {
  return stepper_->grid;
}
const FluidParameters& NavierStokes::parameters() const {
  return stepper_->parameters;
}
const FluidTimings& NavierStokes::timings() const {
  return stepper_->timings;
}

std::size_t NavierStokes::estimate_memory(const Grid& grid, const FluidParameters& parameters) {
  const auto field_bytes = [&](Centring centring) {
    const auto n = point_extent(grid, centring);
    return sizeof(double) * static_cast<std::size_t>(n[0] + 2) * (n[1] + 2) * (n[2] + 2);
  };
  const std::size_t vectors = parameters.convection ? 4 : 3;
  std::size_t bytes =
      2 * field_bytes(Centring::cell) + estimate_solver_memory(pressure_problem(grid), parameters.pressure_solver);
  for (int component = 0; component < 3; ++component) {
    bytes += vectors * field_bytes(face_centrings[component]) +
             estimate_solver_memory(velocity_problem(grid, component, 1.0, 1.0), parameters.velocity_solver);
  }
  return bytes;
}

}  // namespace vesiflow::fluid
