#include "coupling/simulation.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "coupling/errors.h"
#include "fluid/operators.h"
#include "immersed_vesicle.h"
#include "phase_timer.h"
#include "step_control.h"

namespace vesiflow::coupling {
namespace {

/// Steps between two looks at the meshes, which change by a few per cent in that time. Where redistribution does not help it
/// is tried again each time, at the price of about ten steps of a small scene.
constexpr long redistribution_interval = 16;

const Scene& checked(const Scene& scene) {
  check_scene(scene, "scene");
  return scene;
}

std::string blow_up_advice(const Scene& scene) {
  return fmt::format(
      "the explicit tension is unstable above g = dt sigma0/(4 mu h) of {:.3g}, and this scene has g = {:.3g}: reduce "
      "time.step or membrane.sigma0; if g is well below that, the mesh is too coarse for the shape (more "
      "mesh.latitudes) or the vesicle too deflated",
      scene.stable_tension_number(), scene.tension_number());
}

}  // namespace

fluid::Grid grid_of(const Scene& scene) {
  return {scene.domain.lower, scene.domain.upper, scene.domain.cells};
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
  parameters.viscosity = scene.fluid.viscosity_ratio;
  parameters.inertia = scene.fluid.inertia;
  parameters.velocity_solver = solver_options_of(scene.fluid.velocity_solver);
  parameters.pressure_solver = solver_options_of(scene.fluid.pressure_solver);
  return parameters;
}

fluid::BoundaryVelocity flow_of(const Scene& scene) {
  if (scene.flow.type == FlowType::custom)
    throw SceneError(
        "flow.type = \"custom\": stands for the flow of a program of one's own (docs/first_app.md); a scene "
        "file can name rest or shear");
  const double rate = scene.flow.type == FlowType::shear ? scene.flow.rate : 0.0;
  return [rate](const fluid::Vector3& x, double) { return fluid::Vector3{rate * x[2], 0.0, 0.0}; };
}

Simulation::Simulation(const Scene& scene) : Simulation(scene, flow_of(scene), true, scene.flow.type) {}

Simulation::Simulation(const Scene& scene, const fluid::BoundaryVelocity& flow, bool steady)
    : Simulation(scene, flow, steady, FlowType::custom) {}

Simulation::Simulation(const Scene& scene, const fluid::BoundaryVelocity& flow, bool steady, FlowType type)
    : scene_(checked(scene)), fluid_(grid_of(scene), fluid_parameters_of(scene), flow, steady) {
  scene_.flow.type = type;
  if (scene_.flow.start == FlowStart::flow)
    fluid_.set_velocity([&flow](const fluid::Vector3& x) { return flow(x, 0.0); });
  for (std::size_t i = 0; i < scene_.vesicles.size(); ++i)
    vesicles_.push_back(std::make_unique<ImmersedVesicle>(scene_, i, fluid_.grid()));
  if (scene_.mesh.redistribute == Redistribute::when_needed)
    redistribution_.emplace(scene_.mesh.latitudes, moving_degrees(scene_));
  last_redistributions_.reserve(vesicles_.size());
  if (scene_.time.adaptive) step_control_ = std::make_unique<StepControl>(scene_);
  for (auto& v : vesicles_) v->interpolate(time_step(), fluid_.velocity());
}

Simulation::~Simulation() = default;

void Simulation::step() {
  try {
    if (step_control_)
      take_adaptive_step();
    else
      take_step(scene_.time.step);
    redistribute_markers();
  } catch (const std::domain_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
}

void Simulation::take_step(double dt) {
  compute_forces(dt);  // Steps 1 and 2: coefficients, geometry, forces, spreading
  advance_fluid(dt);   // Step 3: Navier-Stokes
  move_markers(dt);    // Steps 4 and 5: interpolation, mesh control, markers, target areas
}

void Simulation::compute_forces(double dt) {
  {
    const PhaseTimer timer(seconds_.spread);
    for (auto& v : vesicles_) v->transfer.clear(fluid_.force());
  }
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    {
      const PhaseTimer timer(seconds_.membrane);
      v.predict(dt);
      check_limits(i);
    }
    const PhaseTimer timer(seconds_.spread);
    v.transfer.update(v.membrane.positions());
    v.transfer.spread(v.membrane.force(), v.membrane.surface().area_weight(), fluid_.force());
  }
}

void Simulation::advance_fluid(double dt) {
  try {
    fluid_.step(dt);
  } catch (const std::runtime_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
}

void Simulation::move_markers(double dt) {
  for (auto& v : vesicles_) {
    const PhaseTimer timer(seconds_.mesh);
    v->advance(dt, fluid_.previous_velocity(), fluid_.velocity(), seconds_.interpolate);
  }
}

void Simulation::redistribute_markers() {
  last_redistributions_.clear();
  if (!redistribution_ || steps() % redistribution_interval != 0) return;
  const vesicle::RedistributionLimits limits{scene_.mesh.max_aspect_ratio, scene_.mesh.max_spectrum_tail};
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    {
      const PhaseTimer timer(seconds_.membrane);
      v.update();
    }
    const PhaseTimer timer(seconds_.mesh);
    if (!limits.passed_by(vesicle::mesh_quality(v.membrane.surface()))) continue;
    const vesicle::RedistributionReport report = v.membrane.redistribute(*redistribution_);
    if (!report.moved) continue;
    v.motion->restart();
    v.is_current = false;
    v.interpolate(time_step(), fluid_.velocity());
    ++v.redistributions;
    last_redistributions_.push_back({i, report});
  }
}

void Simulation::check_limits(std::size_t i) const {
  const vesicle::Membrane& membrane = vesicles_[i]->membrane;
  if (membrane.parameters().sigma0 == 0.0) return;  // nothing holds local areas, so nothing is promised of them
  const double worst = (membrane.surface().area_weight() / membrane.target_areas() - 1.0).abs().maxCoeff();
  if (!(worst <= scene_.limits.local_area_error))
    throw SimulationStopped(
        fmt::format("the local area error of vesicle {} is {:.3g}, above limits.local_area_error = {:g}", i, worst,
                    scene_.limits.local_area_error),
        blow_up_advice(scene_));
}

std::vector<vesicle::Diagnostics> Simulation::measure() {
  const PhaseTimer timer(seconds_.diagnostics);
  std::vector<vesicle::Diagnostics> all;
  for (std::size_t i = 0; i < vesicles_.size(); ++i)
    all.push_back(vesicle::measure(membrane(i), vesicles_[i]->velocities.fluid, vesicles_[i]->velocities.mesh));
  return all;
}

double Simulation::max_divergence() const {
  return fluid::max_divergence(fluid_.velocity());
}

const vesicle::Membrane& Simulation::membrane(std::size_t i) {
  try {
    vesicles_.at(i)->update();
  } catch (const std::domain_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
  return vesicles_[i]->membrane;
}

long Simulation::redistributions(std::size_t i) const {
  return static_cast<long>(vesicles_.at(i)->redistributions);
}

const vesicle::VectorField& Simulation::marker_velocity(std::size_t i) const {
  return vesicles_.at(i)->velocities.fluid;
}

MarkerStatistics Simulation::marker_statistics(std::size_t i) const {
  return vesicles_.at(i)->motion->statistics();
}

bool Simulation::finished() const {
  if (!step_control_) return steps() >= scene_.steps();
  constexpr double round_off = 1e-12;
  return time() >= scene_.time.end * (1.0 - round_off);
}

double Simulation::time_step() const {
  return step_control_ && steps() > 0 ? fluid_.clock().time_step : scene_.time.step;
}

PhaseSeconds Simulation::phase_seconds() const {
  PhaseSeconds all = seconds_;
  all.mesh -= all.interpolate;  // interpolation is asked for inside the move
  all.fluid_convection = fluid_.timings().convection;
  all.fluid_momentum = fluid_.timings().momentum;
  all.fluid_projection = fluid_.timings().projection;
  return all;
}

SimulationState Simulation::state() const {
  SimulationState state{
      fluid_.velocity().clone(), fluid_.previous_velocity().clone(), fluid_.pressure().clone(), fluid_.clock(), {}, {}};
  for (const auto& v : vesicles_) {
    const auto history = v->motion->history();
    state.vesicles.push_back({v->membrane.state(), {history.begin(), history.end()}, v->redistributions});
  }
  if (step_control_) state.step_control = step_control_->state();
  return state;
}

void Simulation::restore(const SimulationState& state) {
  if (state.vesicles.size() != vesicles_.size())
    throw std::invalid_argument(
        fmt::format("the state has {} vesicles, the scene {}", state.vesicles.size(), vesicles_.size()));
  fluid_.restore(state.velocity, state.previous_velocity, state.pressure, state.clock);
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    v.membrane.restore(state.vesicles[i].membrane);
    v.is_current = false;
    v.restore_history(fluid_.clock().time_step, state.vesicles[i].motion_history);
    v.redistributions = state.vesicles[i].redistributions;
    v.interpolate(time_step(), fluid_.velocity());
  }
  if (step_control_) step_control_->restore(state.step_control);
  last_redistributions_.clear();
}

}  // namespace vesiflow::coupling
