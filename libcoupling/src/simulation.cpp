#include "coupling/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "blow_up_guard.h"
#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/overlap.h"
#include "each_vesicle.h"
#include "external_forces.h"
#include "fluid/operators.h"
#include "immersed_vesicle.h"
#include "motion/implicit_step.h"
#include "motion/start_control.h"
#include "phase_timer.h"
#include "step_control.h"
#include "viscosity_contrast.h"

namespace vesiflow::coupling {
namespace {

Scene checked(Scene scene, FlowType type) {
  scene.flow.type = type;
  check_scene(scene, "scene");
  return scene;
}

std::unique_ptr<ViscosityContrast> contrast_of(const Scene& scene) {
  return scene.has_viscosity_contrast() ? std::make_unique<ViscosityContrast>(scene, grid_of(scene)) : nullptr;
}

fluid::FluidParameters fluid_parameters_of(const Scene& scene, const ViscosityContrast* contrast) {
  fluid::FluidParameters parameters = fluid_parameters_of(scene);
  if (contrast != nullptr) parameters.viscosity = contrast->field();
  return parameters;
}

}  // namespace

fluid::Grid grid_of(const Scene& scene) {
  return {scene.domain.lower, scene.domain.upper, scene.domain.cells, scene.domain.periodic, scene.domain.mirror};
}

fluid::SolverOptions solver_options_of(SolverChoice choice) {
  switch (choice) {
    case SolverChoice::fft:
      return fluid::FftOptions{};
    case SolverChoice::cholmod:
      return fluid::CholmodOptions{};
    case SolverChoice::pcg:
      return fluid::PcgOptions{};
    case SolverChoice::automatic:
      break;
  }
  return fluid::AutoOptions{};
}

fluid::FluidParameters fluid_parameters_of(const Scene& scene) {
  fluid::FluidParameters parameters;
  parameters.reynolds_number = scene.fluid.reynolds_number;
  parameters.viscous_treatment = scene.fluid.viscous_treatment;
  parameters.inertia = scene.fluid.inertia;
  parameters.velocity_solver = solver_options_of(scene.fluid.velocity_solver);
  parameters.pressure_solver = solver_options_of(scene.fluid.pressure_solver);
  return parameters;
}

Simulation::Simulation(const Scene& scene) : Simulation(scene, flow_of(scene), scene.flow.type) {}

Simulation::Simulation(const Scene& scene, const fluid::BoundaryVelocity& flow, bool steady)
    : Simulation(scene, custom_flow(flow, steady)) {}

Simulation::Simulation(const Scene& scene, const Flow& flow) : Simulation(scene, flow, FlowType::custom) {}

Simulation::Simulation(const Scene& scene, const Flow& flow, FlowType type)
    : scene_(checked(scene, type)),
      contrast_(contrast_of(scene_)),
      fluid_(grid_of(scene_), fluid_parameters_of(scene_, contrast_.get()), flow.velocity, flow.steady) {
  if (scene_.flow.start == FlowStart::flow)
    fluid_.set_velocity([&flow](const fluid::Vector3& x) { return flow.velocity(x, 0.0); });
  if (scene_.domain.periodic[0]) fluid_.uniform_force()[0] = flow.driving_force;
  make_vesicles();
  if (scene_.mesh.redistribute == Redistribute::when_needed)
    for (std::size_t i = 0; i < vesicles_.size(); ++i)
      redistributions_.try_emplace(scene_.latitudes(i), scene_.latitudes(i), moving_degrees(scene_, i));
  last_redistributions_.reserve(vesicles_.size());
  if (scene_.time.adaptive)
    step_control_ = std::make_unique<StepControl>(scene_);
  else if (scene_.follows_shape())
    start_control_ = std::make_unique<StartControl>();
  const bool walls_are_known = type != FlowType::custom;
  guard_ = std::make_unique<BlowUpGuard>(
      scene_, walls_are_known ? flow.greatest_speed : std::numeric_limits<double>::infinity());
  plan_last_step();
  for (auto& v : vesicles_) v->interpolate(time_step(), fluid_.velocity());
}

Simulation::~Simulation() = default;

// And what refers to them.
void Simulation::make_vesicles() {
  implicit_step_.reset();
  external_forces_.reset();
  vesicles_.clear();
  for (std::size_t i = 0; i < scene_.vesicles.size(); ++i) {
    const vesicle::MembraneState* membrane = start_ ? &start_->membranes[i] : nullptr;
    vesicles_.push_back(std::make_unique<ImmersedVesicle>(scene_, i, fluid_.grid(), membrane));
  }
  external_forces_ = std::make_unique<ExternalForces>(scene_, fluid_.grid(), vesicles_);
  if (scene_.time.markers != "implicit") return;
  std::vector<ImplicitStep::Member> members;
  for (const auto& v : vesicles_) members.push_back({&dynamic_cast<ImplicitMotion&>(*v->motion), &v->membrane});
  implicit_step_ = std::make_unique<ImplicitStep>(
      std::move(members), FixedPoint::Limits{scene_.time.implicit_tolerance, scene_.time.implicit_iterations});
}

std::vector<vesicle::Diagnostics> Simulation::measure() {
  const PhaseTimer timer(phases_.diagnostics);
  std::vector<vesicle::Diagnostics> all(vesicles_.size());
  or_stop(scene_, [&] {
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
  return fluid::max_divergence(fluid_.velocity());
}

const vesicle::Membrane& Simulation::membrane(std::size_t i) {
  ImmersedVesicle& vesicle = *vesicles_.at(i);
  or_stop(scene_, [&] { vesicle.update(); });
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
  return time() >= scene_.time.end * (1.0 - round_off);
}

void Simulation::plan_last_step() {
  constexpr double round_off = 1e-6;  // of a step
  last_step_ =
      steps() + static_cast<long>(std::max(0.0, std::ceil((scene_.time.end - time()) / scene_.time.step - round_off)));
}

void Simulation::set_time_step(double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt))
    throw std::invalid_argument(fmt::format("the time step {} must be > 0 and finite", dt));
  if (step_control_) throw std::invalid_argument("adaptive steps have a length of their own");
  scene_.time.step = dt;
  plan_last_step();
}

double Simulation::time_step() const {
  return step_control_ && steps() > 0 ? fluid_.clock().time_step : scene_.time.step;
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
  for (const vesicle::MembraneState& membrane : start->membranes) anew.vesicles.push_back({membrane, {}, 0});
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
    state.vesicles.push_back({v->membrane.state(), {history.begin(), history.end()}, v->redistributions});
  }
  state.clock.steps = steps();
  if (step_control_) state.step_control = step_control_->state();
  if (start_control_) state.step_control = start_control_->state();
  return state;
}

void Simulation::restore(const SimulationState& state) {
  if (state.vesicles.size() != vesicles_.size())
    throw std::invalid_argument(
        fmt::format("the state has {} vesicles, the scene {}", state.vesicles.size(), vesicles_.size()));
  if (state.start && state.start->membranes.size() != vesicles_.size())
    throw std::invalid_argument(fmt::format("the state has started from {} vesicles, the scene has {}",
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
    v.interpolate(time_step(), fluid_.velocity());
  }
  if (step_control_) step_control_->restore(state.step_control);
  if (start_control_) start_control_->restore(state.step_control);
  plan_last_step();
  last_redistributions_.clear();
}

}  // namespace vesiflow::coupling
