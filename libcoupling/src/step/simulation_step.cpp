// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A step of the coupled method, as section 3.3 of the paper has it, and what is looked at after it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "motion/implicit_step.h"
#include "motion/start_control.h"
#include "phase_timer.h"
#include "step/blow_up_guard.h"
#include "step/each_vesicle.h"
#include "step/external_forces.h"
#include "step/immersed_vesicle.h"
#include "step/step_control.h"
#include "viscosity/phase_inertia.h"
#include "viscosity/viscosity_contrast.h"

namespace vesiflow::coupling {
namespace {

/// Steps between two looks at the meshes, which change by a few per cent in that time. Where redistribution does not help it
/// is tried again each time, at the price of about ten steps of a small parameters.
constexpr long redistribution_interval = 16;

/// Change of a membrane's velocity, relative, below which another solve is not worth it, and the most of them. Against a
/// tolerance of 1e-6 the inclination of tank_treading_sharp.toml on 32^3 cells differs at t = 2 by less than 0.0005
/// degrees for ratios from 0.05 to 5, by 0.003 at 20 and 0.014 at 100, and the frequency by less than 0.04 %.
constexpr double interface_tolerance = 1e-3;
constexpr int most_interface_passes = 60;

/// Spacings between a membrane of two viscosities with inertia and a mirror plane that it is on one side of. Ghosts, half a spacing beyond
/// the plane, have the phase that is the mirror image of the one continued there: no point where both phases count, within a spacing of the
/// membrane, may have one for a neighbour. The rest is what it moves in two steps.
constexpr double phases_from_mirror = 2.0;

}  // namespace

void Simulation::step() {
  interface_passes_ = 0;
  or_stop(parameters_, flow_, [this] {
    if (step_control_)
      take_adaptive_step();
    else if (start_control_ && start_control_->watches(steps()))
      take_start_step();
    else
      take_step(parameters_.time.step);
    check_growth();
    redistribute_markers();
  });
}

void Simulation::take_step(double dt) {
  compute_forces(dt);  // Steps 1 and 2: coefficients, geometry, forces, spreading
  update_viscosity();
  if (implicit_step_) return solve_step(dt);
  const bool corrects_fluid = parameters_.corrects_fluid(dt);
  if (corrects_fluid) fluid_.keep_force();
  advance_fluid(dt);  // Step 3: Navier-Stokes
  move_markers(dt);   // Steps 4 and 5: interpolation, mesh control, markers, target areas
  if (corrects_fluid) correct_fluid();
  keep_phases();
}

// Steps 1 to 5 with forces at the new state, again and again until it answers to itself.
void Simulation::solve_step(double dt) {
  fluid_.remember();
  implicit_step_->take(dt, [&](bool again) {
    if (again) {
      fluid_.retry();
      spread_forces(dt);
    }
    advance_fluid(dt);
    move_markers(dt);
  });
  keep_phases();
}

void Simulation::compute_forces(double dt) {
  {
    const PhaseTimer timer(phases_.membrane);
    for (auto& v : vesicles_)
      if (v->two_phase && fluid_.steps() > 0) v->two_phase->begin_step(dt / fluid_.clock().time_step);
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) { vesicles_[i]->predict(dt); });
    for (std::size_t i = 0; i < vesicles_.size(); ++i) check_limits(i);
  }
  spread_forces(dt);
}

void Simulation::spread_forces(double dt) {
  clear_forces();
  {
    const PhaseTimer timer(phases_.membrane);
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) { vesicles_[i]->update(); });
  }
  if (external_forces_->any()) {
    const PhaseTimer timer(phases_.external_forces);
    external_forces_->compute(time());
  }
  {
    const PhaseTimer timer(phases_.spread);
    find_neighbours();
    for_each_vesicle(vesicles_.size(), [&](std::size_t i) { vesicles_[i]->meet_grid(dt, !neighbours_[i].empty()); });
  }
  prepare_inertia(dt);
  for (auto& v : vesicles_)
    if (v->two_phase) v->two_phase->begin_iteration();
  put_forces();
  if (!fluid_.grid().has_walls()) hold_the_fluid();
}

// Sharp membranes whose boxes are so near to each other that markers of the one may read inside the other.
void Simulation::find_neighbours() {
  neighbours_.resize(vesicles_.size());
  for (auto& of_one : neighbours_) {
    of_one.reserve(vesicles_.size());
    of_one.clear();
  }
  if (!vesicles_[0]->sharp) return;
  const fluid::Grid& grid = fluid_.grid();
  // Of one of them that is on one side of a mirror plane, the image counts as well.
  const auto are_near = [&](const ImmersedVesicle& a, const ImmersedVesicle& b) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto x = a.membrane.positions().col(axis), y = b.membrane.positions().col(axis);
      const double low = y.minCoeff() - x.maxCoeff(), high = y.maxCoeff() - x.minCoeff();
      // Some image of the second box is from `low` to `high` of the first, give or take what is read.
      const double reach = a.sharp->reading_reach();
      const double shift = grid.periodic[axis] ? std::ceil((low - reach) / grid.length(axis)) * grid.length(axis) : 0.0;
      const bool is_near_image = (a.sharp->has_image(axis) || b.sharp->has_image(axis)) &&
                                 x.minCoeff() + y.minCoeff() - 2.0 * grid.lower[axis] <= reach;
      if (!is_near_image && (low - shift > reach || high - shift < -reach)) return false;
    }
    return true;
  };
  // Its own image, one period on or beyond a mirror plane.
  const auto is_near_itself = [&](const ImmersedVesicle& v) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto x = v.membrane.positions().col(axis);
      const double reach = v.sharp->reading_reach();
      if (grid.periodic[axis] && x.maxCoeff() - x.minCoeff() + reach >= grid.length(axis)) return true;
      if (v.sharp->has_image(axis) && 2.0 * (x.minCoeff() - grid.lower[axis]) <= reach) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < vesicles_.size(); ++i)
    if (is_near_itself(*vesicles_[i])) neighbours_[i].push_back(i);
  for (std::size_t i = 0; i < vesicles_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (are_near(*vesicles_[i], *vesicles_[j])) {
        neighbours_[i].push_back(j);
        neighbours_[j].push_back(i);
      }
}

void Simulation::clear_forces() {
  const PhaseTimer timer(phases_.spread);
  for (auto& v : vesicles_) v->clear(fluid_);
  if (fluid_force_)
    put_fluid_force();
  else if (phase_inertia_)
    phase_inertia_->clear(fluid_.force());
}

// On one grid, in this order: sums are the same for any number of threads.
void Simulation::put_forces(bool correction) {
  const PhaseTimer timer(phases_.spread);
  for (auto& v : vesicles_) v->put_force(fluid_, correction);
  for (std::size_t i = 0; i < vesicles_.size(); ++i)
    for (const std::size_t other : neighbours_[i]) vesicles_[i]->sharp->read_past(*vesicles_[other]->sharp);
  if (phase_inertia_) phase_inertia_->add_to(fluid_.force());
}

// In the place of what is in the field of forces: markers add theirs.
void Simulation::put_fluid_force() {
  const auto put = [this](auto& component, int axis) {
    for (int k = 0; k < component.extent(2); ++k)
      for (int j = 0; j < component.extent(1); ++j)
        for (int i = 0; i < component.extent(0); ++i)
          component(i, j, k) = fluid_force_(component.position(i, j, k), time())[static_cast<std::size_t>(axis)];
  };
  put(fluid_.force().x, 0);
  put(fluid_.force().y, 1);
  put(fluid_.force().z, 2);
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
    iterate_interfaces();
  } catch (const std::invalid_argument& error) {
    if (fluid_.steps() > 0) throw;  // the state's fault
    // The velocity solver is made in the first step, or refused.
    throw ParameterError(fmt::format("fluid.velocity_solver: {}", error.what()));
  } catch (const std::runtime_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(parameters_, flow_));
  }
}

// The implicit terms have moved the membranes otherwise than the fluid has; with their forces it does.
void Simulation::correct_fluid() {
  clear_forces();
  for (auto& v : vesicles_)
    if (v->two_phase) v->two_phase->begin_iteration();
  put_forces(true);
  fluid_.solve_again();
  improve_interfaces();
}

// The velocities of sharp membranes between two viscosities; returns the largest change.
double Simulation::improve_interfaces() {
  const PhaseTimer timer(phases_.interpolate);
  mean_flow_ = mean_flow();
  double change = 0.0;
  for (auto& v : vesicles_) {
    v->mean_flow = mean_flow_;
    if (v->two_phase) change = std::max(change, v->improve_interface(fluid_.velocity()));
  }
  return change;
}

// Forces at the velocity that they lead to.
void Simulation::iterate_interfaces() {
  if (std::ranges::none_of(vesicles_, [](const auto& v) { return v->two_phase.has_value(); })) return;
  int passes = 1;
  ++interface_passes_;
  for (double change = improve_interfaces(); change > interface_tolerance; change = improve_interfaces()) {
    if (passes == most_interface_passes)
      throw std::runtime_error(
          fmt::format("the velocities of membranes between two viscosities still change by {:.2g} after {} solves",
                      change, passes));
    clear_forces();
    put_forces();
    fluid_.solve_again();
    ++passes;
    ++interface_passes_;
  }
}

void Simulation::prepare_inertia(double dt) {
  if (!phase_inertia_) return;
  const PhaseTimer timer(phases_.spread);
  for (std::size_t i = 0; i < vesicles_.size(); ++i) check_mirrors(i);
  if (fluid_.steps() == 0) phase_inertia_->begin(fluid_.velocity());
  const double a = phase_inertia_->prepare(fluid_, dt);
  for (auto& v : vesicles_)
    if (v->two_phase)
      v->two_phase->set_inertia(a * std::pow(0.75 / std::numbers::pi * v->membrane.initial_volume(), 2.0 / 3.0));
}

void Simulation::check_mirrors(std::size_t i) const {
  const ImmersedVesicle& v = *vesicles_[i];
  const fluid::Grid& grid = fluid_.grid();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(v.two_phase && v.sharp->has_image(axis))) continue;
    const double from_plane = (v.membrane.positions().col(axis).minCoeff() - grid.lower[axis]) / grid.spacing(axis);
    if (!(from_plane >= phases_from_mirror))
      throw SimulationStopped(
          fmt::format("vesicle {} is {:.3g} grid spacings from the plane of symmetry {} = {:g}; with another viscosity "
                      "inside, inertia "
                      "and coupling.method = \"sharp\" it must keep {:g} from it and its mirror image",
                      i, from_plane, "xyz"[axis], grid.lower[axis], phases_from_mirror),
          "take the whole box (domain.mirror), a finer grid (domain.cells) or fluid.inertia = \"none\"");
  }
}

void Simulation::keep_phases() {
  if (!phase_inertia_) return;
  const PhaseTimer timer(phases_.spread);
  phase_inertia_->keep(fluid_.velocity(), fluid_.clock().time_step);
}

// Without walls the mean of mu u is such that that of u is zero. The fluid's solver takes the sum of mu u over the points of
// the grid to be zero, which is not its integral. With inertia the solver has a mean of its own, from the forces.
fluid::Vector3 Simulation::mean_flow() const {
  fluid::Vector3 mean{};
  const fluid::Grid& grid = fluid_.grid();
  if (grid.has_walls() || phase_inertia_) return mean;
  for (const auto& v : vesicles_) {
    if (!v->two_phase) continue;
    const vesicle::Vector3 lacking = v->two_phase->displaced(v->membrane.surface()) + v->sharp->integral_beyond_sum();
    for (int axis = 0; axis < 3; ++axis)
      mean[static_cast<std::size_t>(axis)] -= lacking[axis] / (grid.length(0) * grid.length(1) * grid.length(2));
  }
  return mean;
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
  const vesicle::RedistributionLimits limits{parameters_.mesh.max_aspect_ratio, parameters_.mesh.max_spectrum_tail};
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    {
      const PhaseTimer timer(phases_.membrane);
      v.update();
    }
    const PhaseTimer timer(phases_.redistribution);
    if (!limits.passed_by(vesicle::mesh_quality(v.membrane.surface()))) continue;
    vesicle::MeshRedistribution& redistribution = redistributions_.at(parameters_.latitudes(i));
    const vesicle::RedistributionReport report = v.membrane.redistribute(redistribution);
    if (!report.moved) continue;
    v.carry_interface_velocity(redistribution);
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
  if (!(worst <= parameters_.limits.local_area_error))
    throw SimulationStopped(
        fmt::format("the local area error of vesicle {} is {:.3g}, above limits.local_area_error = {:g}", i, worst,
                    parameters_.limits.local_area_error),
        blow_up_advice(parameters_, flow_));
}

void Simulation::check_growth() {
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    const PhaseTimer timer(phases_.mesh);
    ImmersedVesicle& v = *vesicles_[i];
    v.noise.update(v.velocities.membrane);
    if (const std::string found = guard_->look_at(i, v.noise, v.membrane.positions()); !found.empty())
      throw SimulationStopped(found, blow_up_advice(parameters_, flow_));
  }
  if (!guard_->watches_fluid(steps())) return;
  if (const std::string found = guard_->look_at(fluid_velocity(), steps()); !found.empty())
    throw SimulationStopped(found, blow_up_advice(parameters_, flow_));
}

}  // namespace vesiflow::coupling
