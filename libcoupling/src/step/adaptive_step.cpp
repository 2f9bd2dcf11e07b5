// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Steps of a simulation that are tried, judged by their errors, and taken back.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "phase_timer.h"
#include "step/blow_up_guard.h"
#include "step/immersed_vesicle.h"
#include "step/step_control.h"
#include "viscosity/phase_inertia.h"
#include "viscosity/viscosity_contrast.h"

namespace vesiflow::coupling {
namespace {

// The root is taken of a number in [1, 8): std::cbrt of numbers a power of eight apart may differ in their last bits, and steps would depend
// on the unit of length.
double effective_radius(double volume) {
  const double cube = 0.75 * volume / std::numbers::pi;
  const int thirds = static_cast<int>(std::floor(std::ilogb(cube) / 3.0));
  return std::ldexp(std::cbrt(std::ldexp(cube, -3 * thirds)), thirds);
}

}  // namespace

void Simulation::take_adaptive_step() {
  remember();
  for (;;) {
    const double dt = step_control_->next(time());
    std::string failure;
    if (try_step(dt, failure)) return;
    ++rejected_steps_;
    take_back();
    if (step_control_->is_smallest(dt))
      throw SimulationStopped(fmt::format("a step of time.smallest_step = {:g} is still too long: {}",
                                          parameters_.time.smallest_step, failure),
                              "time.tolerance or limits too small, or the mesh too coarse for what the vesicle does "
                              "(more mesh.latitudes)");
  }
}

bool Simulation::try_step(double dt, std::string& failure) {
  try {
    StepErrors errors;
    or_stop(parameters_, flow_, [&] {
      take_step(dt);
      for (std::size_t i = 0; i < vesicles_.size(); ++i) weigh_step(i, errors);
    });
    if (step_control_->accepts(dt, errors)) return true;
    failure = step_control_->reason();
  } catch (const SimulationStopped& stopped) {
    step_control_->fail(dt);
    failure = stopped.what();
  }
  return false;
}

void Simulation::weigh_step(std::size_t i, StepErrors& errors) {
  ImmersedVesicle& v = *vesicles_[i];
  const PhaseTimer timer(phases_.membrane);
  const double area = v.area, volume = v.volume;  // of the geometry before the step
  v.update();
  check_limits(i);
  const vesicle::Membrane& m = v.membrane;
  errors.area_change = std::max(errors.area_change, std::abs(m.surface().area() - area) / m.initial_area());
  errors.volume_change = std::max(errors.volume_change, std::abs(m.surface().volume() - volume) / m.initial_volume());
  if (const auto error = v.motion->position_error())
    errors.position = std::max(errors.position.value_or(0.0), *error / effective_radius(m.initial_volume()));
}

void Simulation::remember() {
  for (auto& v : vesicles_) {
    const PhaseTimer timer(phases_.membrane);
    v->update();
  }
  const PhaseTimer timer(phases_.adaptation);
  fluid_.remember();
  if (contrast_) contrast_->remember();
  if (phase_inertia_) phase_inertia_->remember();
  remembered_.resize(vesicles_.size());
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    ImmersedVesicle& v = *vesicles_[i];
    v.area = v.membrane.surface().area();
    v.volume = v.membrane.surface().volume();
    const auto history = v.motion->history();
    remembered_[i].membrane = v.membrane.state();
    remembered_[i].motion_history.assign(history.begin(), history.end());
    remembered_[i].interface_velocity = v.interface_velocity();
    remembered_[i].previous_interface_velocity = v.previous_interface_velocity();
  }
}

void Simulation::take_back() {
  const PhaseTimer timer(phases_.adaptation);
  fluid_.retry();
  if (contrast_) contrast_->take_back();
  if (phase_inertia_) phase_inertia_->take_back();
  for (std::size_t i = 0; i < vesicles_.size(); ++i) {
    vesicles_[i]->membrane.restore(remembered_[i].membrane);
    vesicles_[i]->is_current = false;
    vesicles_[i]->restore_history(fluid_.clock().time_step, remembered_[i].motion_history);
    vesicles_[i]->restore_interface_velocity(remembered_[i].interface_velocity,
                                             remembered_[i].previous_interface_velocity);
  }
}

}  // namespace vesiflow::coupling
