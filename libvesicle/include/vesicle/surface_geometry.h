// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// How much of the geometry is computed.
enum class GeometryDetail {
  first_form,  ///< tangents, dual tangents, normal, area element: needs first derivatives
  curvature,   ///< and mean and Gaussian curvature: needs second derivatives
};

/// First and second fundamental forms of X(theta, phi) at the nodes of one grid, from the coefficients of X:
/// tangents, normal, curvatures (Eq. (10)), area element, and the dual tangents
///
///     X^theta = (G X_theta - F X_phi) / (EG - F^2),  X^phi = (E X_phi - F X_theta) / (EG - F^2)
///
/// with E = X_theta . X_theta, F = X_theta . X_phi, G = X_phi . X_phi. They make Eqs. (11) and (12) short:
///
///     grad s = s_theta X^theta + s_phi X^phi,  div U = U_theta . X^theta + U_phi . X^phi.
class VESIFLOW_VESICLE_EXPORT SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const SphereGrid& grid);  ///< for surfaces on that grid

  /// Recomputes the geometry up to the given detail.
  /// \throws std::invalid_argument unless the harmonics live on the grid of this geometry and the positions have three
  /// fields.
  /// \throws std::domain_error if an area element is zero or not finite: the markers have folded or collapsed.
  void update(const SphericalHarmonics& harmonics, const Coefficients& positions,
              GeometryDetail detail = GeometryDetail::curvature);

  /// Adds the curvatures to a geometry of the same positions that lacks them.
  /// \throws std::invalid_argument as update().
  void add_curvature(const SphericalHarmonics& harmonics, const Coefficients& positions);

  bool has_curvature() const { return has_curvature_; }  ///< whether the curvatures are there

  /// X_theta, shape (markers, 3).
  const VectorField& tangent_theta() const { return theta_; }
  const VectorField& tangent_phi() const { return phi_; }  ///< X_phi

  /// X^theta, shape (markers, 3).
  const VectorField& dual_theta() const { return dual_theta_; }
  const VectorField& dual_phi() const { return dual_phi_; }  ///< X^phi

  /// Outward unit normal X_theta x X_phi / |X_theta x X_phi|.
  const VectorField& normal() const { return normal_; }

  /// |X_theta x X_phi| = sqrt(EG - F^2).
  const ScalarField& area_element() const { return area_element_; }

  /// H, the mean of the principal curvatures, +1 on the unit sphere. This and all below are there if has_curvature().
  const ScalarField& mean_curvature() const { return mean_curvature_; }
  /// K, the product of the principal curvatures.
  const ScalarField& gaussian_curvature() const { return gaussian_curvature_; }

  /// Second derivative X_theta_theta, as the two that follow.
  const VectorField& theta_theta() const { return theta_theta_; }
  const VectorField& theta_phi() const { return theta_phi_; }  ///< X_theta_phi
  const VectorField& phi_phi() const { return phi_phi_; }      ///< X_phi_phi

 private:
  void check_arguments(const SphericalHarmonics& harmonics, const Coefficients& positions) const;
  void check_area_elements() const;
  void update_first_form();
  void update_second_form();

  SphereGrid grid_;
  bool has_curvature_ = false;
  VectorField theta_, phi_, theta_theta_, theta_phi_, phi_phi_;
  VectorField dual_theta_, dual_phi_, normal_;
  ScalarField area_element_, mean_curvature_, gaussian_curvature_;
};

}  // namespace vesiflow::vesicle
