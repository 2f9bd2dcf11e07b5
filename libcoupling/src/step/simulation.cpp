// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/overlap.h"
#include "fluid/operators.h"
#include "motion/implicit_step.h"
#include "motion/start_control.h"
#include "phase_timer.h"
#include "step/blow_up_guard.h"
#include "step/each_vesicle.h"
#include "step/external_forces.h"
#include "step/immersed_vesicle.h"
#include "step/step_control.h"
#include "viscosity/phase_inertia.h"
#include "viscosity/physical_velocity.h"
#include "viscosity/viscosity_contrast.h"

namespace vesiflow::coupling {
namespace {

const SimulationParameters& checked(const SimulationParameters& parameters, const Flow& flow) {
  check(parameters, flow);
  return parameters;
}

std::unique_ptr<ViscosityContrast> contrast_of(const SimulationParameters& parameters) {
  return parameters.has_viscosity_field() ? std::make_unique<ViscosityContrast>(parameters, grid_of(parameters))
                                          : nullptr;
}

fluid::FluidParameters fluid_parameters_of(const SimulationParameters& parameters, const ViscosityContrast* contrast) {
  fluid::FluidParameters of_fluid = fluid_parameters_of(parameters);
  if (contrast != nullptr) of_fluid.viscosity = contrast->field();
  if (parameters.has_phase_inertia())  // which takes off what that is too much
    of_fluid.reynolds_number = parameters.phase_splitting().solved_reynolds_number;
  return of_fluid;
}

// What check() let pass may be too much for a direct solver, which counts exactly.
fluid::NavierStokes fluid_of(const SimulationParameters& parameters, const ViscosityContrast* contrast,
                             const Flow& flow) {
  try {
    return {grid_of(parameters), fluid_parameters_of(parameters, contrast), flow.velocity, flow.motion};
  } catch (const std::invalid_argument& error) {
    throw ParameterError(fmt::format("fluid.velocity_solver = \"{}\", fluid.pressure_solver = \"{}\": {}",
                                     fluid::name(parameters.fluid.velocity_solver),
                                     fluid::name(parameters.fluid.pressure_solver), error.what()));
  }
}

}  // namespace

Simulation::Simulation(const SimulationParameters& parameters, const Flow& flow)
    : parameters_(checked(parameters, flow)),
      flow_(flow),
      contrast_(contrast_of(parameters_)),
      fluid_(fluid_of(parameters_, contrast_.get(), flow)) {
  if (flow.start == FlowStart::flow)
    fluid_.set_velocity([&flow](const fluid::Vector3& x) { return flow.velocity(x, 0.0); });
  if (parameters_.domain.periodic[0]) fluid_.uniform_force()[0] = flow.driving_force;
  if (parameters_.coupling.method == CouplingMethod::sharp) fluid_.divergence_source();
  make_vesicles();
  if (parameters_.mesh.redistribute == Redistribute::when_needed)
    for (std::size_t i = 0; i < vesicles_.size(); ++i)
      redistributions_.try_emplace(parameters_.latitudes(i), parameters_.latitudes(i), moving_degrees(parameters_, i));
  last_redistributions_.reserve(vesicles_.size());
  if (parameters_.time.adaptive)
    step_control_ = std::make_unique<StepControl>(parameters_, flow_);
  else if (parameters_.follows_shape())
    start_control_ = std::make_unique<StartControl>();
  guard_ =
      std::make_unique<BlowUpGuard>(parameters_, flow.greatest_speed.value_or(std::numeric_limits<double>::infinity()));
  plan_last_step();
  for (auto& v : vesicles_) read_velocity(*v);
}

Simulation::~Simulation() = default;

// And what refers to them.
void Simulation::make_vesicles() {
  implicit_step_.reset();
  phase_inertia_.reset();
  external_forces_.reset();
  vesicles_.clear();
  for (std::size_t i = 0; i < parameters_.vesicles.size(); ++i) {
    const vesicle::MembraneState* membrane = start_ ? &start_->membranes[i] : nullptr;
    vesicles_.push_back(std::make_unique<ImmersedVesicle>(parameters_, flow_, i, fluid_.grid(), membrane));
  }
  external_forces_ = std::make_unique<ExternalForces>(parameters_, fluid_.grid(), vesicles_, own_forces_);
  if (parameters_.has_scaled_velocity() && !physical_velocity_)
    physical_velocity_ = std::make_unique<PhysicalVelocity>(fluid_.grid());
  if (parameters_.has_phase_inertia()) {
    std::vector<PhaseInertia::Body> bodies;
    for (const auto& v : vesicles_)
      if (v->two_phase) bodies.push_back({&*v->sharp, v->two_phase->ratio()});
    phase_inertia_ =
        std::make_unique<PhaseInertia>(fluid_.grid(), parameters_.fluid.reynolds_number, parameters_.phase_splitting(),
                                       std::move(bodies), parameters_.fluid.inertia == fluid::Inertia::full);
    fluid_.keep_force();  // the interfaces' velocities are iterated
  }
  if (parameters_.time.markers != MarkerMotion::implicit) return;
  std::vector<ImplicitStep::Member> members;
  for (const auto& v : vesicles_) members.push_back({&dynamic_cast<ImplicitMotion&>(*v->motion), &v->membrane});
  implicit_step_ = std::make_unique<ImplicitStep>(
      std::move(members),
      FixedPoint::Limits{parameters_.time.implicit_tolerance, parameters_.time.implicit_iterations});
}

// A step has made the fluid's velocity, or it is as it was given.
void Simulation::read_velocity(ImmersedVesicle& vesicle) {
  if (fluid_.steps() > 0)
    vesicle.interpolate(time_step(), fluid_.velocity());
  else
    vesicle.meet_start(time_step(), fluid_.velocity());
}

void Simulation::add_force(MembraneForce force) {
  if (!force) throw std::invalid_argument("add_force: there is no function to call");
  own_forces_.push_back(std::move(force));
  external_forces_ = std::make_unique<ExternalForces>(parameters_, fluid_.grid(), vesicles_, own_forces_);
}

void Simulation::set_fluid_force(FluidForce force) {
  fluid_force_ = std::move(force);
  fluid_.force().fill(0.0);
}

std::vector<vesicle::Diagnostics> Simulation::measure() {
  const PhaseTimer timer(phases_.diagnostics);
  std::vector<vesicle::Diagnostics> all(vesicles_.size());
  or_stop(parameters_, flow_, [&] {
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) {
      all[i] = vesicle::measure(membrane(i), vesicles_[i]->velocities.fluid, vesicles_[i]->velocities.membrane);
    });
  });
  return all;
}

std::vector<double> Simulation::nearest_distances() const {
  std::vector<const vesicle::VectorField*> markers;
  for (const auto& v : vesicles_) markers.push_back(&v->membrane.positions());
  return coupling::nearest_distances(fluid_.grid(), markers);
}

double Simulation::max_divergence() const {
  return fluid::max_divergence(fluid_.velocity(), fluid_.given_divergence());
}

const vesicle::Membrane& Simulation::membrane(std::size_t i) {
  ImmersedVesicle& vesicle = *vesicles_.at(i);
  or_stop(parameters_, flow_, [&] { vesicle.update(); });
  return vesicle.membrane;
}

double Simulation::velocity_noise(std::size_t i) const {
  return vesicles_.at(i)->noise.value();
}

double Simulation::membrane_speed(std::size_t i) const {
  return vesicles_.at(i)->noise.greatest_speed();
}

bool Simulation::suspects_blow_up() const {
  return guard_->suspects();
}

long Simulation::start_parts() const {
  return start_control_ ? start_control_->parts() : 0;
}

long Simulation::redistributions(std::size_t i) const {
  return static_cast<long>(vesicles_.at(i)->redistributions);
}

const vesicle::VectorField& Simulation::marker_velocity(std::size_t i) const {
  return vesicles_.at(i)->velocities.fluid;
}

const fluid::Field<fluid::Cell>* Simulation::viscosity() const {
  return contrast_ ? contrast_->field().get() : nullptr;
}

MarkerStatistics Simulation::marker_statistics(std::size_t i) const {
  return vesicles_.at(i)->motion->statistics();
}

bool Simulation::finished() const {
  if (!step_control_) return steps() >= last_step_;
  constexpr double round_off = 1e-12;
  return time() >= parameters_.time.end * (1.0 - round_off);
}

void Simulation::plan_last_step() {
  constexpr double round_off = 1e-6;  // of a step
  last_step_ = steps() + static_cast<long>(std::max(
                             0.0, std::ceil((parameters_.time.end - time()) / parameters_.time.step - round_off)));
}

void Simulation::set_time_step(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw std::invalid_argument(fmt::format("the time step {} must be > 0 and finite", dt));
  if (step_control_) throw std::invalid_argument("adaptive steps have a length of their own");
  parameters_.time.step = dt;
  plan_last_step();
}

double Simulation::time_step() const {
  return step_control_ && steps() > 0 ? fluid_.clock().time_step : parameters_.time.step;
}

Phases Simulation::phases() const {
  Phases all = phases_;
  all.mesh.seconds -= all.interpolate.seconds + all.thickness_correction.seconds;  // asked for inside the move
  const fluid::FluidTimings& of_fluid = fluid_.timings();
  all.fluid_convection = of_fluid.convection;
  all.fluid_viscous = of_fluid.viscous;
  all.fluid_momentum = of_fluid.momentum;
  all.fluid_projection = of_fluid.projection;
  return all;
}

PartEntries Simulation::part_entries() const {
  PartEntries sum;
  for (const auto& v : vesicles_) {
    const vesicle::MembraneEntries& of_membrane = v->membrane.entries();
    const MotionEntries of_motion = v->motion->entries();
    sum.tension += of_membrane.tension;
    sum.strain += of_membrane.target_areas + of_motion.strain;
    sum.conservation += of_membrane.conservation + of_motion.conservation;
  }
  return sum;
}

void Simulation::start(std::shared_ptr<const Start> start, const fluid::FaceVector& velocity,
                       const fluid::Field<fluid::Cell>& pressure) {
  fluid_.start_from(velocity, pressure);
  SimulationState anew = state();
  anew.vesicles.clear();
  for (const vesicle::MembraneState& membrane : start->membranes) anew.vesicles.push_back({membrane, {}, 0, {}});
  anew.start = std::move(start);
  restore(anew);
}

SimulationState Simulation::state() const {
  SimulationState state{fluid_.velocity().clone(),
                        fluid_.previous_velocity().clone(),
                        fluid_.pressure().clone(),
                        fluid_.clock(),
                        {},
                        {},
                        start_};
  for (const auto& v : vesicles_) {
    const auto history = v->motion->history();
    state.vesicles.push_back({v->membrane.state(),
                              {history.begin(), history.end()},
                              v->redistributions,
                              v->interface_velocity(),
                              v->previous_interface_velocity()});
  }
  state.clock.steps = steps();
  state.mean_flow = mean_flow_;
  if (phase_inertia_ && fluid_.steps() > 0) {
    state.outer_velocities = phase_inertia_->outer_state(fluid_);
    state.earlier_step = phase_inertia_->earlier_step();
    std::size_t body = 0;
    for (std::size_t i = 0; i < vesicles_.size(); ++i) {
      if (!vesicles_[i]->two_phase) continue;
      state.vesicles[i].inner_velocities = phase_inertia_->inner_state(body++);
    }
  }
  if (step_control_) state.step_control = step_control_->state();
  if (start_control_) state.step_control = start_control_->state();
  return state;
}

void Simulation::restore_phases(const SimulationState& state) {
  std::vector<PhaseInertia::InnerState> inner;
  for (std::size_t i = 0; i < vesicles_.size(); ++i)
    if (vesicles_[i]->two_phase) inner.push_back(state.vesicles[i].inner_velocities);
  phase_inertia_->restore(state.outer_velocities, inner, state.earlier_step, fluid_);
}

void Simulation::restore(const SimulationState& state) {
  if (state.vesicles.size() != vesicles_.size())
    throw std::invalid_argument(
        fmt::format("the state has {} vesicles, the simulation {}", state.vesicles.size(), vesicles_.size()));
  if (state.start && state.start->membranes.size() != vesicles_.size())
    throw std::invalid_argument(fmt::format("the state has started from {} vesicles, the simulation has {}",
                                            state.start->membranes.size(), vesicles_.size()));
  fluid_.restore(state.velocity, state.previous_velocity, state.pressure, state.clock);
  extra_steps_ = 0;
  if (state.start || start_) {  // what membranes keep of their start depends on it
    start_ = state.start;
    make_vesicles();
  }
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    v.membrane.restore(state.vesicles[i].membrane);
    v.is_current = false;
    v.restore_history(fluid_.clock().time_step, state.vesicles[i].motion_history);
    v.redistributions = state.vesicles[i].redistributions;
    v.noise.restart();
    if (fluid_.steps() > 0)
      v.restore_interface_velocity(state.vesicles[i].interface_velocity, state.vesicles[i].previous_interface_velocity);
  }
  if (phase_inertia_ && fluid_.steps() > 0) restore_phases(state);
  mean_flow_ = state.mean_flow;
  for (auto& v : vesicles_) {
    v->mean_flow = mean_flow_;
    read_velocity(*v);
  }
  if (step_control_) step_control_->restore(state.step_control);
  if (start_control_) start_control_->restore(state.step_control);
  plan_last_step();
  last_redistributions_.clear();
}

}  // namespace vesiflow::coupling
