// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupling/marker_integrator.h"
#include "motion/membrane_motion.h"
#include "motion/mirror_symmetry.h"
#include "motion/step_error.h"

namespace vesiflow::coupling {

/// The paper's motion: markers are material points and move with the filtered velocity of the fluid, by an integrator
/// that knows neither vesicle nor grid, and target areas follow their slip.
class MaterialMotion final : public MembraneMotion {
 public:
  struct Parameters {
    bool interpolates_in_time = false;  ///< the fluid velocity is that of the time within the step, and not of its end
    bool has_stages = false;            ///< of the integrator: its last velocity is not that of the step
    bool estimates_error = false;       ///< for adaptive steps
  };

  /// \param integrator of a state of three numbers for each marker
  MaterialMotion(const Parameters& parameters, std::unique_ptr<MarkerIntegrator> integrator,
                 const MirrorSymmetry& symmetry, const vesicle::Membrane& membrane);

  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override;
  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override;

  std::optional<double> position_error() const override { return error_ ? error_->value() : std::nullopt; }
  MarkerStatistics statistics() const override { return integrator_->statistics(); }

  /// Of the integrator, followed by that of the error.
  std::span<const double> history() const override;
  void restore_history(double dt, std::span<const double> history) override;
  void restart() override;

 private:
  // What the integrator's callback needs of the step under way; the callback is made once, so that steps do not
  // allocate.
  struct Step {
    double dt = 0.0;
    const VelocityAt* velocity_at = nullptr;
    vesicle::Membrane* membrane = nullptr;
    MarkerVelocities* velocities = nullptr;
  };

  void evaluate(double fraction, const VelocityAt::Positions& positions);

  Parameters parameters_;
  MirrorSymmetry symmetry_;
  vesicle::VectorField positions_, displacement_;
  std::unique_ptr<MarkerIntegrator> integrator_;
  std::optional<StepError> error_;
  MarkerVelocity filtered_velocity_;
  Step step_;
  mutable std::vector<double> history_;
};

}  // namespace vesiflow::coupling
