#pragma once

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Elastic tension that keeps every surface element near its target area dA0, Eq. (31):
///   sigma = sigma0 (dA0/dA) ln(dA/dA0).
/// The ratio is taken of cell areas dA_ij, which is the ratio of the area elements |X_theta x X_phi|.
class TensionForce {
 public:
  /// @throws std::invalid_argument unless sigma0 is finite and >= 0.
  explicit TensionForce(double sigma0);

  double sigma0() const { return sigma0_; }

  /// Tension at the markers for target cell areas of shape (markers), all > 0.
  /// @throws std::invalid_argument for a wrong number of target areas.
  void evaluate(const Surface& surface, const ScalarField& target_areas, ScalarField& tension) const;

  /// Adds F_sigma = div(sigma P), the divergence form of Eq. (20), to `force`, shape (markers, 3), force per
  /// unit area.
  void add_to(const Surface& surface, const ScalarField& tension, VectorField& force);

  /// E_sigma = (sigma0/2) sum ln(dA/dA0)^2 dA0, of which F_sigma is minus the derivative.
  double energy(const Surface& surface, const ScalarField& target_areas) const;

 private:
  double sigma0_;
  VectorField divergence_;
};

}  // namespace vesiflow::vesicle
