#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "coupling/marker_transfer.h"
#include "coupling/scene.h"
#include "fluid/field.h"
#include "membrane_motion.h"
#include "thickness_correction.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// One vesicle in the fluid: its membrane, the transfers between its markers and the grid, and how it moves.
struct ImmersedVesicle {
  ImmersedVesicle(const Scene& scene, std::size_t number, const fluid::Grid& grid);

  /// Geometry and forces at the present state; looking at a vesicle between two steps costs the next step nothing, unless
  /// that predicts.
  void update();

  /// Geometry and forces at the state whose forces drive the step.
  void predict(double dt);

  /// To the end of the step, in the fluid velocity of the new time. Adds the seconds of interpolation.
  void advance(double dt, const fluid::FaceVector& velocity, double& interpolation_seconds);

  /// Velocities at markers that no step has moved yet.
  void interpolate(double dt, const fluid::FaceVector& velocity);

  /// Force per area on the fluid (markers x 3).
  const vesicle::VectorField& force() const { return total_force ? *total_force : membrane.force(); }

  vesicle::Membrane membrane;
  MarkerTransfer transfer;
  MarkerVelocities velocities;
  std::optional<vesicle::VectorField> total_force;  ///< of the membrane and from outside, if there are any from outside
  std::unique_ptr<MembraneMotion> motion;
  std::int64_t redistributions = 0;
  bool is_current = false;  ///< whether geometry and forces are those of the membrane's state

 private:
  std::optional<ThicknessCorrection> thickness_;
  VelocityAt velocity_at_;  // made once, so that steps do not allocate
  const fluid::FaceVector* fluid_velocity_ = nullptr;
  double* interpolation_seconds_ = nullptr;
};

/// Degrees of the velocity that shapes the membrane of vesicle number i.
int moving_degrees(const Scene& scene, std::size_t i);

}  // namespace vesiflow::coupling
