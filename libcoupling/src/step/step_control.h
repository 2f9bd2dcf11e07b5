// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupling/simulation_parameters.h"

namespace vesiflow::coupling {

/// What a trial step did, the worst over all vesicles.
struct StepErrors {
  std::optional<double> position;  ///< error of the positions in effective radii; nothing where it is not known
  double area_change = 0.0;        ///< relative, of a total area in this step
  double volume_change = 0.0;
};

/// Chooses the lengths of adaptive steps so that
///   position error <= tolerance,  area change <= limits.area_error,  volume change <= limits.volume_error.
/// in each step. The largest ratio e of the two sides grows like dt^2 where the scheme is of first order, so that the next step is
///   dt 0.9 e^-0.35 e_old^0.2
/// with the ratio of the step before (a PI controller: Hairer & Wanner, Solving Ordinary Differential Equations II, IV.2), no
/// less than 0.2 dt and no more than 1.5 dt: BDF2 is stable while steps grow by less than 1 + sqrt 2. Changes that are not
/// worth a new fluid operator are left.
class StepControl {
 public:
  StepControl(const SimulationParameters& parameters, const Flow& flow);

  /// Length of the step to try from `time`. Ends on time.end, with the last two steps alike.
  double next(double time) const;

  /// Whether a trial step of that length is good enough; chooses the length of the next, or of the repeated one.
  bool accepts(double dt, const StepErrors& errors);
  /// The same for a trial that could not be computed.
  void fail(double dt);

  /// Whether steps cannot become shorter than this trial.
  bool is_smallest(double dt) const { return dt <= smallest_; }
  /// Says which error refused the last trial.
  std::string reason() const { return reason_; }

  /// For a continued run.
  std::vector<double> state() const { return {step_, last_ratio_, may_grow_ ? 1.0 : 0.0}; }
  /// \throws std::invalid_argument for what no state() has given
  void restore(std::span<const double> state);

 private:
  double tolerance_, area_limit_, volume_limit_;
  double smallest_, largest_, end_;
  double step_;  // wanted, if time.end allows it
  double last_ratio_ = 1.0;
  bool may_grow_ = true;  // not by the step that follows a refused one
  std::string reason_;
};

}  // namespace vesiflow::coupling
