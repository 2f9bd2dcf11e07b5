// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The steps of a start: whole, or in parts where shapes start far from rest.
#include <algorithm>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "motion/start_control.h"
#include "phase_timer.h"
#include "step/blow_up_guard.h"
#include "step/immersed_vesicle.h"
#include "viscosity/viscosity_contrast.h"

namespace vesiflow::coupling {

void Simulation::take_start_step() {
  const double end = time() + parameters_.time.step;
  for (;;) {
    remember();
    curvatures_.resize(vesicles_.size());
    for (std::size_t i = 0; i < vesicles_.size(); ++i)
      curvatures_[i] = total_curvature(vesicles_[i]->membrane.surface());
    double change = 0.0;
    while (!try_part(start_control_->next(time(), end, parameters_.time.step), change)) {
      take_back();
      start_control_->shorten();
    }
    if (start_control_->advance(change, steps() - 1)) break;
    ++extra_steps_;
  }
  if (start_control_->watches(steps())) return;
  fluid_.forget();  // the memory of starts
  if (contrast_) contrast_->forget();
  remembered_ = {};
  curvatures_ = {};
}

// Whether the part is short enough. The shortest is taken as it is.
bool Simulation::try_part(double dt, double& change) {
  const long before = steps();
  try {
    or_stop(parameters_, flow_, [&] {
      take_step(dt);
      change = 0.0;
      for (std::size_t i = 0; i < vesicles_.size(); ++i) change = std::max(change, dt * rate_of(i));
    });
  } catch (const SimulationStopped&) {
    if (start_control_->is_shortest()) throw;
    return false;
  }
  return start_control_->accepts(change, before) || start_control_->is_shortest();
}

double Simulation::rate_of(std::size_t i) {
  ImmersedVesicle& v = *vesicles_[i];
  const PhaseTimer timer(phases_.membrane);
  v.update();
  check_limits(i);
  return rate_of_shape(v.membrane.surface(), v.velocities.membrane, curvatures_[i]);
}

}  // namespace vesiflow::coupling
