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
#include "implicit_step.h"
#include "phase_timer.h"
#include "step_control.h"
#include "viscosity_contrast.h"

namespace vesiflow::coupling {
namespace {

/// Steps between two looks at the meshes, which change by a few per cent in that time. Where redistribution does not help it
/// is tried again each time, at the price of about ten steps of a small scene.
constexpr long redistribution_interval = 16;

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

std::string blow_up_advice(const Scene& scene) {
  if (const double convection = stable_convection_step(scene); !scene.time.adaptive && scene.time.step > convection)
    return fmt::format("the explicit convection is unstable for time.step above about {:.3g} near the walls: reduce it",
                       convection);
  const double limit = scene.stable_tension_number();
  if (!std::isfinite(limit))
    return fmt::format(
        "reduce time.step, or membrane.sigma0 where g = dt sigma0/(4 h) is above about 50 (here it is {:.3g}); or the "
        "mesh is too coarse for the shape (more mesh.latitudes) or the vesicle too deflated",
        scene.tension_number());
  return fmt::format(
      "the explicit tension is unstable above g = dt sigma0/(4 mu h) of {:.3g}, and this scene has g = {:.3g}: reduce "
      "time.step or membrane.sigma0; if g is well below that, the mesh is too coarse for the shape (more "
      "mesh.latitudes) or the vesicle too deflated",
      limit, scene.tension_number());
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
  for (std::size_t i = 0; i < scene_.vesicles.size(); ++i)
    vesicles_.push_back(std::make_unique<ImmersedVesicle>(scene_, i, fluid_.grid()));
  external_forces_ = std::make_unique<ExternalForces>(scene_, fluid_.grid(), vesicles_);
  if (scene_.mesh.redistribute == Redistribute::when_needed)
    for (std::size_t i = 0; i < vesicles_.size(); ++i)
      redistributions_.try_emplace(scene_.latitudes(i), scene_.latitudes(i), moving_degrees(scene_, i));
  last_redistributions_.reserve(vesicles_.size());
  if (scene_.time.markers == "implicit") implicit_step_ = std::make_unique<ImplicitStep>(scene_, vesicles_);
  if (scene_.time.adaptive) step_control_ = std::make_unique<StepControl>(scene_);
  const bool walls_are_known = type != FlowType::custom;
  guard_ = std::make_unique<BlowUpGuard>(
      scene_, walls_are_known ? flow.greatest_speed : std::numeric_limits<double>::infinity());
  plan_last_step();
  for (auto& v : vesicles_) v->interpolate(time_step(), fluid_.velocity());
}

Simulation::~Simulation() = default;

void Simulation::step() {
  try {
    if (step_control_)
      take_adaptive_step();
    else
      take_step(scene_.time.step);
    check_growth();
    redistribute_markers();
  } catch (const std::domain_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
}

void Simulation::take_step(double dt) {
  compute_forces(dt);  // Steps 1 and 2: coefficients, geometry, forces, spreading
  update_viscosity();
  if (implicit_step_) return solve_step(dt);
  advance_fluid(dt);  // Step 3: Navier-Stokes
  move_markers(dt);   // Steps 4 and 5: interpolation, mesh control, markers, target areas
}

// Steps 1 to 5 with forces at the new state, again and again until it answers to itself.
void Simulation::solve_step(double dt) {
  fluid_.remember();
  implicit_step_->take(dt, [&](bool again) {
    if (again) {
      fluid_.retry();
      spread_forces();
    }
    advance_fluid(dt);
    move_markers(dt);
  });
}

void Simulation::compute_forces(double dt) {
  {
    const PhaseTimer timer(phases_.membrane);
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) { vesicles_[i]->predict(dt); });
    for (std::size_t i = 0; i < vesicles_.size(); ++i) check_limits(i);
  }
  spread_forces();
}

void Simulation::spread_forces() {
  {
    const PhaseTimer timer(phases_.spread);
    for (auto& v : vesicles_) v->transfer.clear(fluid_.force());
  }
  {
    const PhaseTimer timer(phases_.membrane);
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) { vesicles_[i]->update(); });
  }
  if (external_forces_->any()) {
    const PhaseTimer timer(phases_.external_forces);
    external_forces_->compute();
  }
  const PhaseTimer timer(phases_.spread);
  for_each_vesicle(vesicles_.size(), [&](std::size_t i) {
    ImmersedVesicle& v = *vesicles_[i];
    v.transfer.update(v.membrane.positions());
  });
  for (auto& v : vesicles_) {  // on one grid, in this order: sums are the same for any number of threads
    v->transfer.spread(v->force(), v->membrane.surface().area_weight(), fluid_.force());
    if (const vesicle::VectorField* owed = v->motion->owed_force())
      v->transfer.spread(*owed, v->membrane.surface().area_weight(), fluid_.force());
  }
  if (!fluid_.grid().has_walls()) hold_the_fluid();
}

// Without walls nothing takes up a total force, and all would accelerate for ever: the mean pressure gradient balances it.
void Simulation::hold_the_fluid() {
  const fluid::Grid& grid = fluid_.grid();
  const fluid::Vector3 total = external_forces_->total();
  for (int axis = 0; axis < 3; ++axis)
    fluid_.uniform_force()[axis] = -total[axis] / (grid.length(0) * grid.length(1) * grid.length(2));
}

// Of the same markers as the forces.
void Simulation::update_viscosity() {
  if (!contrast_) return;
  const PhaseTimer timer(phases_.indicator);
  for (std::size_t i = 0; i < vesicles_.size(); ++i) contrast_->add(i, vesicles_[i]->membrane.surface());
  contrast_->update();
}

void Simulation::advance_fluid(double dt) {
  try {
    fluid_.step(dt);
  } catch (const std::invalid_argument& error) {  // the velocity solver is made in the first step, or refused
    throw SceneError(fmt::format("fluid.velocity_solver: {}", error.what()));
  } catch (const std::runtime_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
}

void Simulation::move_markers(double dt) {
  fluid::PhaseAccount all;
  {
    const PhaseTimer timer(all);
    for_each_vesicle(vesicles_.size(),
                     [&](std::size_t i) { vesicles_[i]->advance(dt, fluid_.previous_velocity(), fluid_.velocity()); });
  }
  // Vesicles may have moved side by side: the time that passed is shared out as they spent theirs.
  double spent = 0.0;
  for (const auto& v : vesicles_) spent += v->moving.mesh.seconds;
  const double share = spent > 0.0 ? all.seconds / spent : 0.0;
  for (const auto& v : vesicles_)
    for (const auto phase : {&Phases::mesh, &Phases::interpolate, &Phases::thickness_correction}) {
      const fluid::PhaseAccount& account = v->moving.*phase;
      (phases_.*phase).entries += account.entries;
      (phases_.*phase).seconds += share * account.seconds;
    }
}

void Simulation::redistribute_markers() {
  last_redistributions_.clear();
  if (redistributions_.empty() || steps() % redistribution_interval != 0) return;
  const vesicle::RedistributionLimits limits{scene_.mesh.max_aspect_ratio, scene_.mesh.max_spectrum_tail};
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    {
      const PhaseTimer timer(phases_.membrane);
      v.update();
    }
    const PhaseTimer timer(phases_.redistribution);
    if (!limits.passed_by(vesicle::mesh_quality(v.membrane.surface()))) continue;
    const vesicle::RedistributionReport report = v.membrane.redistribute(redistributions_.at(scene_.latitudes(i)));
    if (!report.moved) continue;
    v.motion->restart();
    v.noise.restart();
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

void Simulation::check_growth() {
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    const PhaseTimer timer(phases_.mesh);
    ImmersedVesicle& v = *vesicles_[i];
    v.noise.update(v.velocities.membrane);
    if (const std::string found = guard_->look_at(i, v.noise, v.membrane.positions()); !found.empty())
      throw SimulationStopped(found, blow_up_advice(scene_));
  }
  if (const std::string found = guard_->look_at(fluid_.velocity(), steps()); !found.empty())
    throw SimulationStopped(found, blow_up_advice(scene_));
}

std::vector<vesicle::Diagnostics> Simulation::measure() {
  const PhaseTimer timer(phases_.diagnostics);
  std::vector<vesicle::Diagnostics> all(vesicles_.size());
  for_each_vesicle(vesicles_.size(), [&](std::size_t i) {
    all[i] = vesicle::measure(membrane(i), vesicles_[i]->velocities.fluid, vesicles_[i]->velocities.membrane);
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
  try {
    vesicles_.at(i)->update();
  } catch (const std::domain_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(scene_));
  }
  return vesicles_[i]->membrane;
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
    v.noise.restart();
    v.interpolate(time_step(), fluid_.velocity());
  }
  if (step_control_) step_control_->restore(state.step_control);
  plan_last_step();
  last_redistributions_.clear();
}

}  // namespace vesiflow::coupling
