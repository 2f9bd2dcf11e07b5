// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What a motion of the membrane must leave at these values; nothing given: nothing is corrected.
struct Conserved {
  std::optional<double> volume;  ///< the enclosed volume V0
  std::optional<double> area;    ///< the total area A0
};

/// Corrects motions along the normal so that volume and area come out exactly. The correction is a combination of n,
/// the derivative of the volume, and F[2 H] n, where 2 H n is the derivative of the area and F keeps the degrees n <
/// 10: the high degrees of H are noise in a simulation, and moving along them makes more of it, without bound if the
/// area is to grow. For a shape of few degrees the smallest correction in the L2 norm over the membrane. Nothing
/// allocates after the first correction of each kind.
class VESIFLOW_VESICLE_EXPORT ConservationProjection {
 public:
  /// With smoothing_degrees > 0, displacements are corrected along n and 2 H n, each component of them cut to that many
  /// degrees, instead of n and F[2 H] n: the products with n have high degrees again, and what a correction adds at
  /// these would feed on itself from step to step.
  /// \throws std::invalid_argument unless a given volume and area are finite and > 0 and smoothing_degrees >= 0.
  ConservationProjection(const SphereGrid& grid, const Conserved& conserved, int smoothing_degrees = 0);

  /// Velocity, shape (markers, 3): U += (a + F[2 H] b) n so that afterwards int U . n dA = -(V - V0)/dt and
  /// int 2 H U . n dA = -(A - A0)/dt; moving with U for dt restores both to O(dt^2).
  /// \throws std::invalid_argument unless dt is finite and > 0, or for a wrong size or a surface on another grid.
  /// \throws std::domain_error if volume and area cannot both be met because H is nearly constant (a sphere), or if the
  /// velocity or its correction is not finite (the velocity is then as it was).
  void correct_velocity(const Surface& surface, double dt, VectorField& velocity);

  /// Velocity, shape (markers, 3): changed along the directions of displacements so that what is conserved does not
  /// change, whether the surface has its target values or not: int U . n dA = 0 and int 2 H U . n dA = 0.
  /// \throws std::invalid_argument for a wrong size or a surface on another grid.
  /// \throws std::domain_error as correct_velocity().
  void remove_rates(const Surface& surface, VectorField& velocity);

  /// Displacement D, shape (markers, 3): D += (a + F[2 H] b) n, with n and H before the move, so that X + D encloses V0
  /// and has area A0 to a relative 1e-13. Newton's method; meant for D small beside the size of the surface.
  /// \throws std::invalid_argument for a wrong size or a surface on another grid.
  /// \throws std::domain_error as correct_velocity(), and if the iteration does not converge.
  void correct_displacement(const Surface& surface, VectorField& displacement);

  /// The share of 2 H that varies over the surface, 1 - (int H dA)^2 / (A int H^2 dA) in [0, 1): small near a sphere,
  /// where volume and area cannot both be kept.
  static double independence(const Surface& surface);

 private:
  void set_directions(const Surface& surface);
  void smooth_directions(const Surface& surface);
  Eigen::Matrix2d rates(const Surface& surface) const;
  Eigen::Vector2d multipliers(const Surface& surface, const Eigen::Vector2d& missing) const;
  void add(const Eigen::Vector2d& multipliers, VectorField& motion) const;

  SphereGrid grid_;
  Conserved conserved_;
  std::optional<SphericalHarmonics> curvature_filter_;     // F, if the area is kept
  std::optional<SphericalHarmonics> displacement_filter_;  // if smoothing_degrees > 0
  Coefficients coefficients_, displacement_coefficients_;
  ScalarField curvature_;                       // F[2 H]
  VectorField along_normal_, along_curvature_;  // directions of the corrections
  std::optional<Surface> moved_;                // made when a displacement is first corrected
  VectorField positions_;
};

}  // namespace vesiflow::vesicle
