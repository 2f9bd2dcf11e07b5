#pragma once

#include <optional>

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What a motion of the membrane must leave at these values; nothing given: nothing is corrected.
struct Conserved {
  std::optional<double> volume;
  std::optional<double> area;
};

/// Corrects motions along the normal so that volume and area come out exactly. The correction is a combination of the
/// derivatives n of the volume and 2 H n of the area: the smallest one in the L2 norm over the membrane. Nothing allocates after the
/// first correction of each kind.
class ConservationProjection {
 public:
  /// With smoothing_degrees > 0, displacements are corrected along n and 2 H n cut to that many degrees: H is rougher than the
  /// surface by two derivatives, and what a correction adds at high degrees would feed on itself from step to step.
  /// @throws std::invalid_argument unless a given volume and area are finite and > 0 and smoothing_degrees >= 0.
  ConservationProjection(const SphereGrid& grid, const Conserved& conserved, int smoothing_degrees = 0);

  /// Velocity, shape (markers, 3): U += (a + 2 H b) n so that afterwards int U . n dA = -(V - V0)/dt and
  /// int 2 H U . n dA = -(A - A0)/dt; moving with U for dt restores both to O(dt^2).
  /// @throws std::invalid_argument unless dt is finite and > 0; std::domain_error if volume and area cannot both be met because
  /// H is nearly constant (a sphere), or if the velocity or its correction is not finite (the velocity is then as it was).
  void correct_velocity(const Surface& surface, double dt, VectorField& velocity);

  /// Displacement D, shape (markers, 3): D += (a + 2 H b) n, with n and H before the move, so that X + D encloses V0 and has
  /// area A0 to a relative 1e-13. Newton's method; meant for D small beside the size of the surface.
  /// @throws std::domain_error as above, or if the iteration does not converge.
  void correct_displacement(const Surface& surface, VectorField& displacement);

  /// The share of 2 H that varies over the surface, 1 - (int H dA)^2 / (A int H^2 dA) in [0, 1): small near a sphere, where volume and
  /// area cannot both be kept.
  static double independence(const Surface& surface);

 private:
  Eigen::Matrix2d gram(const Surface& surface) const;
  Eigen::Vector2d multipliers(const Surface& surface, const Eigen::Vector2d& missing) const;
  void add(const Surface& surface, const Eigen::Vector2d& multipliers, VectorField& motion) const;
  void set_directions(const Surface& surface);

  SphereGrid grid_;
  Conserved conserved_;
  std::optional<Surface> moved_;  ///< made when a displacement is first corrected
  std::optional<SphericalHarmonics> smoothing_;
  Coefficients coefficients_;
  VectorField positions_;
  VectorField along_normal_, along_curvature_;  // directions of the corrections of a displacement
};

}  // namespace vesiflow::vesicle
