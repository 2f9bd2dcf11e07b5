// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "motion/fixed_point.h"
#include "motion/implicit_motion.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// The step of time.markers = "implicit": the increments of all vesicles are one vector, and the fixed point of their
/// maps (ImplicitMotion) couples them through the fluid.
class ImplicitStep {
 public:
  struct Member {
    ImplicitMotion* motion;
    vesicle::Membrane* membrane;
  };

  ImplicitStep(std::vector<Member> members, const FixedPoint::Limits& limits);

  /// Takes the membranes, at the predicted state with forces there, to the end of the step; their forces are then not
  /// up to date. `evaluate` computes the fluid for the membranes as they stand, and advances their motions in it;
  /// `again` is false where forces and fluid are those of the prediction.
  /// \throws std::domain_error when time.implicit_iterations do not suffice
  void take(double dt, const std::function<void(bool again)>& evaluate);

 private:
  std::vector<Member> members_;
  std::vector<double> increments_;
  std::unique_ptr<FixedPoint> fixed_point_;
};

}  // namespace vesiflow::coupling
