// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/navier_stokes.h"

#include <utility>

#include "step/stepper.h"

namespace vesiflow::fluid {

NavierStokes::NavierStokes(const Grid& grid, const FluidParameters& parameters, BoundaryVelocity boundary,
                           WallMotion motion)
    : stepper_(std::make_unique<Stepper>(grid, parameters, std::move(boundary), motion)) {}

NavierStokes::~NavierStokes() = default;
NavierStokes::NavierStokes(NavierStokes&&) noexcept = default;
NavierStokes& NavierStokes::operator=(NavierStokes&&) noexcept = default;

void NavierStokes::set_velocity(const std::function<Vector3(const Vector3&)>& velocity) {
  stepper_->set_velocity(velocity);
}

void NavierStokes::start_from(const FaceVector& velocity, const Field<Cell>& pressure) {
  stepper_->start_from(velocity, pressure);
}

void NavierStokes::restore(const FaceVector& velocity, const FaceVector& previous_velocity, const Field<Cell>& pressure,
                           const FluidClock& clock) {
  stepper_->restore(velocity, previous_velocity, pressure, clock);
}

void NavierStokes::remember() {
  stepper_->remember();
}

void NavierStokes::forget() {
  stepper_->forget();
}

void NavierStokes::keep_force() {
  stepper_->keep_force();
}

void NavierStokes::solve_again() {
  stepper_->solve_again();
}

void NavierStokes::retry() {
  stepper_->retry();
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
Field<Cell>& NavierStokes::divergence_source() {
  if (!stepper_->source) {
    stepper_->source.emplace(stepper_->grid);
    stepper_->given_divergence.emplace(stepper_->grid);
  }
  return *stepper_->source;
}
const Field<Cell>* NavierStokes::given_divergence() const {
  return stepper_->given_divergence ? &*stepper_->given_divergence : nullptr;
}
Vector3& NavierStokes::uniform_force() {
  return stepper_->uniform_force;
}
const Vector3& NavierStokes::uniform_force() const {
  return stepper_->uniform_force;
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

const FluidReport& NavierStokes::report() const {
  return stepper_->report;
}
std::string NavierStokes::velocity_solver_name() const {
  return stepper_->velocity_solver_name();
}
std::string NavierStokes::pressure_solver_name() const {
  return stepper_->pressure_solver->name();
}

std::size_t NavierStokes::estimate_memory(const Grid& grid, const FluidParameters& parameters) {
  const auto field_bytes = [&](Centring centring) {
    const auto n = point_extent(grid, centring);
    return sizeof(double) * static_cast<std::size_t>(n[0] + 2) * (n[1] + 2) * (n[2] + 2);
  };
  const bool variable = !parameters.viscosity.is_constant();
  const bool stokes = parameters.inertia == Inertia::none;
  std::size_t vectors = 3;
  if (parameters.inertia == Inertia::full) ++vectors;
  if (!stokes && variable && parameters.viscous_treatment != ViscousTreatment::explicit_) ++vectors;
  if (!stokes && variable && parameters.viscous_treatment == ViscousTreatment::implicit) ++vectors;
  std::size_t bytes = 2 * field_bytes(Centring::cell);
  for (const Centring centring : face_centrings) bytes += vectors * field_bytes(centring);
  bytes += estimate_solver_memory(EllipticProblem::pressure(grid), parameters.pressure_solver);
  if (stokes) return bytes + StokesSolver::estimate_memory(grid, parameters.viscosity);
  const EllipticProblem problem = momentum_problem(grid, parameters, 1.0, 1.0);
  return bytes +
         estimate_solver_memory(problem, in_precision(parameters.precision, problem, parameters.velocity_solver));
}

}  // namespace vesiflow::fluid
