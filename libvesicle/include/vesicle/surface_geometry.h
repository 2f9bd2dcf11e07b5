#pragma once

#include "vesicle/spherical_harmonics.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// First and second fundamental forms of X(theta, phi) at the nodes of one grid, from the coefficients of X:
/// tangents, normal, curvatures (Eq. (10)), area element, and the dual tangents
///   X^theta = (G X_theta - F X_phi) / (EG - F^2),  X^phi = (E X_phi - F X_theta) / (EG - F^2)
/// with E = X_theta . X_theta, F = X_theta . X_phi, G = X_phi . X_phi. They make Eqs. (11) and (12) short:
///   grad s = s_theta X^theta + s_phi X^phi,  div U = U_theta . X^theta + U_phi . X^phi.
class SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const SphereGrid& grid);

  /// Recomputes everything. The harmonics must live on the grid of this geometry.
  /// @throws std::domain_error if an area element is zero or not finite: the markers have folded or
  /// collapsed.
  void update(const SphericalHarmonics& harmonics, const Coefficients& positions);

  /// X_theta and X_phi.
  const VectorField& tangent_theta() const { return theta_; }
  const VectorField& tangent_phi() const { return phi_; }

  /// X^theta and X^phi.
  const VectorField& dual_theta() const { return dual_theta_; }
  const VectorField& dual_phi() const { return dual_phi_; }

  /// Outward unit normal X_theta x X_phi / |X_theta x X_phi|.
  const VectorField& normal() const { return normal_; }

  /// |X_theta x X_phi| = sqrt(EG - F^2).
  const ScalarField& area_element() const { return area_element_; }

  /// Mean of the principal curvatures, +1 on the unit sphere.
  const ScalarField& mean_curvature() const { return mean_curvature_; }
  const ScalarField& gaussian_curvature() const { return gaussian_curvature_; }

 private:
  void update_first_form();
  void update_second_form();

  VectorField theta_, phi_, theta_theta_, theta_phi_, phi_phi_;
  VectorField dual_theta_, dual_phi_, normal_;
  ScalarField area_element_, mean_curvature_, gaussian_curvature_;
};

}  // namespace vesiflow::vesicle
