#pragma once

#include <optional>

#include "vesicle/coefficients.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What a motion of the membrane must leave at these values; nothing given: nothing is corrected.
struct Conserved {
  std::optional<double> volume;
  std::optional<double> area;
};

/// Corrects motions along the normal so that volume and area come out exactly. The correction is a combination of n, the
/// derivative of the volume, and F[2 H] n, where 2 H n is the derivative of the area and F keeps the degrees n < 10: the high
/// degrees of H are noise in a simulation, and moving along them makes more of it, without bound if the area is to grow. For a
/// shape of few degrees the smallest correction in the L2 norm over the membrane. Nothing allocates after the first correction of
/// each kind.
class ConservationProjection {
 public:
  /// @throws std::invalid_argument unless a given volume and area are finite and > 0.
  ConservationProjection(const SphereGrid& grid, const Conserved& conserved);

  /// Velocity, shape (markers, 3): U += (a + F[2 H] b) n so that afterwards int U . n dA = -(V - V0)/dt and
  /// int 2 H U . n dA = -(A - A0)/dt; moving with U for dt restores both to O(dt^2).
  /// @throws std::invalid_argument unless dt is finite and > 0; std::domain_error if volume and area cannot both be met because
  /// H is nearly constant (a sphere), or if the velocity or its correction is not finite (the velocity is then as it was).
  void correct_velocity(const Surface& surface, double dt, VectorField& velocity);

  /// Displacement D, shape (markers, 3): D += (a + F[2 H] b) n, with n and H before the move, so that X + D encloses V0 and has
  /// area A0 to a relative 1e-13. Newton's method; meant for D small beside the size of the surface.
  /// @throws std::domain_error as above, or if the iteration does not converge.
  void correct_displacement(const Surface& surface, VectorField& displacement);

 private:
  void smooth_curvature(const Surface& surface);
  Eigen::Matrix2d rates(const Surface& surface) const;
  Eigen::Vector2d multipliers(const Surface& surface, const Eigen::Vector2d& missing) const;
  void add(const Surface& surface, const Eigen::Vector2d& multipliers, VectorField& motion) const;

  SphereGrid grid_;
  Conserved conserved_;
  std::optional<SphericalHarmonics> smoothing_;  ///< if the area is kept
  Coefficients coefficients_;
  ScalarField curvature_;         ///< F[2 H]
  std::optional<Surface> moved_;  ///< made when a displacement is first corrected
  VectorField positions_;
};

}  // namespace vesiflow::vesicle
