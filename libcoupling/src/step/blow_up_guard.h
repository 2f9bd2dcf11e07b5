// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/errors.h"
#include "coupling/simulation_parameters.h"
#include "fluid/field.h"
#include "step/velocity_noise.h"

namespace vesiflow::coupling {

/// Finds velocities that grow by themselves, while they are still finite.
///
/// Membranes: their noise (velocity_noise.h) is above limits.velocity_noise times their greatest speed in eight steps on end.
/// Speeds below 0.1 r/t_c count as that. Runs that are stable have had up to 0.25 in their first ten steps and below 0.1 later, most below
/// 0.01; unstable ones reach 0.5 to 1 (docs/stability.md#guard).
///
/// Fluid, in every eighth step: a component of the velocity is above three times all that walls and membranes have had. Not with a flow of
/// one's own, whose walls are not known.
class BlowUpGuard {
 public:
  /// \param wall_speed greatest velocity of the walls; infinity if it is not known
  BlowUpGuard(const SimulationParameters& parameters, double wall_speed);

  /// After a step. Each returns what it has found, or nothing.
  std::string look_at(std::size_t vesicle, const VelocityNoise& noise, const vesicle::VectorField& positions);
  std::string look_at(const fluid::FaceVector& velocity, long step);
  /// Whether the second looks at the velocity after this step.
  bool watches_fluid(long step) const;

  /// Whether the noise of a membrane is above its limit: a checkpoint would keep it.
  bool suspects() const;

 private:
  double limit_;
  double harmless_speed_;       // below which noise is
  double known_speed_;          // greatest of walls and membranes
  std::vector<int> too_noisy_;  // steps on end, for each membrane
};

/// What to do about a simulation that has blown up: its most likely cause by what is known of limits.
std::string blow_up_advice(const SimulationParameters& parameters, const Flow& flow);

/// Does what the state of a run is asked for. To the libraries a state that diverges is an argument out of range: in the course of a run it is no
/// one's mistake, but the end of the run.
/// \throws SimulationStopped for std::domain_error and std::invalid_argument
template <class Action>
auto or_stop(const SimulationParameters& parameters, const Flow& flow, const Action& action) {
  try {
    return action();
  } catch (const std::domain_error& error) {
    throw SimulationStopped(error.what(), blow_up_advice(parameters, flow));
  } catch (const std::invalid_argument& error) {
    throw SimulationStopped(error.what(), blow_up_advice(parameters, flow));
  }
}

}  // namespace vesiflow::coupling
