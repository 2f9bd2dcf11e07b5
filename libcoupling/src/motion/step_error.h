// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Estimates the local error of a motion of first order in time (forces lag by a step, whatever moves the markers) from the
/// mean velocities W = D/dt of two steps that follow each other: dt^2/2 X'' = dt^2 (W - W_old)/(dt + dt_old) to first order.
class StepError {
 public:
  explicit StepError(Eigen::Index markers) : mean_velocity_(markers, 3) {}

  /// Takes the displacement of a step; afterwards value() is its error.
  void add(double dt, const vesicle::VectorField& displacement) {
    value_.reset();
    if (last_dt_ > 0.0) {
      const double squares = (displacement / dt - mean_velocity_).square().sum();
      const double markers = static_cast<double>(mean_velocity_.rows());
      value_ = dt * dt / (dt + last_dt_) * std::sqrt(squares / markers);
    }
    mean_velocity_ = displacement / dt;
    last_dt_ = dt;
  }

  /// Root mean square over the markers of the error of the last step; nothing for a first step.
  std::optional<double> value() const { return value_; }

  bool has_history() const { return last_dt_ > 0.0; }
  const vesicle::VectorField& history() const { return mean_velocity_; }
  void restore_history(double dt, const Eigen::Ref<const vesicle::VectorField>& mean_velocity) {
    mean_velocity_ = mean_velocity;
    last_dt_ = dt;
    value_.reset();
  }
  void restart() {
    last_dt_ = 0.0;
    value_.reset();
  }

 private:
  vesicle::VectorField mean_velocity_;
  double last_dt_ = 0.0;  // 0 before the first step
  std::optional<double> value_;
};

}  // namespace vesiflow::coupling
