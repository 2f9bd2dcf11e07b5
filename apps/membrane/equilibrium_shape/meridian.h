// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/sphere_grid.h"

namespace equilibrium {

/// Half of the meridian of a shape with an axis (z) and a mirror plane (z = 0), in its own arclength: the colatitude theta
/// of the marker mesh is the arclength from the north pole over ell, so that markers are equally dense along the
/// meridian whatever the shape. The shape is given by its tangent angle,
///   phi(theta) = theta + sum_{k=1}^K b_k sin(2 k theta),  rho' = ell cos phi,  z' = -ell sin phi,
/// which is smooth at the poles and closes on the axis for any b; b = 0 is the sphere of radius ell. The bending
/// energy is nearly quadratic in b, and b_k falls geometrically for equilibrium shapes (a displacement from a spheroid
/// needs three times the degrees and wrinkles).
///
/// Unknowns x = (ell, 2 b_1, 4 b_2, ..., 2 K b_K): in them the second variation of the bending energy at fixed area and
/// volume has eigenvalues of order one, so that gradients need no preconditioner.
class Meridian {
 public:
  /// At the colatitudes of `grid`, with `modes` terms in the sum.
  Meridian(const vesiflow::vesicle::SphereGrid& grid, int modes);

  int modes() const { return static_cast<int>(sine_.cols()); }
  int unknowns() const { return modes() + 1; }

  /// The shape with these unknowns, shape (unknowns).
  void set(const Eigen::VectorXd& x);

  /// Distance from the axis and height at the colatitudes, shape (latitudes).
  const Eigen::ArrayXd& rho() const { return rho_; }
  const Eigen::ArrayXd& z() const { return z_; }

  /// Derivatives with respect to the unknowns, shape (latitudes, unknowns), at the shape of the last set().
  void differentiate(Eigen::ArrayXXd& rho, Eigen::ArrayXXd& z) const;

  /// z at the north pole: the half length of the axis. Negative if the two caps have passed through each other.
  double polar_semi_axis() const { return polar_semi_axis_; }
  double equatorial_radius() const { return equatorial_radius_; }
  double arclength_per_colatitude() const { return ell_; }
  double tangent_angle(double theta) const;
  /// Mean curvature (phi' / ell + sin phi / rho) / 2 at the pole and at the equator.
  double polar_mean_curvature() const;
  double equatorial_mean_curvature() const;
  /// |b_K| and |b_{K-1}|, the larger: what the truncation leaves out is smaller.
  double last_coefficient() const;

 private:
  double tangent_angle_slope(double theta) const;

  int latitudes_;
  int northern_;  ///< rings with theta <= pi/2
  // Gauss-Legendre rule on each of the northern_ + 1 intervals between pole, rings and equator.
  Eigen::ArrayXd angle_, weight_;
  Eigen::ArrayXXd sine_;  ///< sin(2 k angle), shape (rule nodes, modes)

  double ell_ = 1;
  double polar_semi_axis_ = 0, equatorial_radius_ = 0;
  Eigen::ArrayXd b_;
  Eigen::ArrayXd weighted_cosine_, weighted_sine_;  ///< of phi, times ell and the rule's weight
  Eigen::ArrayXd rho_, z_;
};

}  // namespace equilibrium
