#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fixed_point.h"
#include "implicit_motion.h"
#include "step/immersed_vesicle.h"

namespace vesiflow::coupling {

/// The step of time.markers = "implicit": the increments of all vesicles are one vector, and the fixed point of their maps
/// (ImplicitMotion) couples them through the fluid.
class ImplicitStep {
 public:
  /// For vesicles whose motions are ImplicitMotion.
  ImplicitStep(const SimulationParameters& parameters, std::span<const std::unique_ptr<ImmersedVesicle>> vesicles);

  /// Takes the vesicles, at the predicted state with forces there, to the end of the step. `evaluate` computes the fluid for the
  /// membranes as they stand, and advances them in it; `again` is false where forces and fluid are those of the prediction.
  /// \throws std::domain_error when time.implicit_iterations do not suffice
  void take(double dt, const std::function<void(bool again)>& evaluate);

 private:
  std::span<const std::unique_ptr<ImmersedVesicle>> vesicles_;
  std::vector<ImplicitMotion*> motions_;
  std::vector<double> increments_;
  std::unique_ptr<FixedPoint> fixed_point_;
};

}  // namespace vesiflow::coupling
