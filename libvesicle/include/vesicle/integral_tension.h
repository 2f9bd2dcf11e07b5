// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What the integral tension depends on.
struct IntegralTensionParameters {
  double rate = 0;   ///< r >= 0, per unit time; 2 to 10 is what works in shear flow
  int degrees = 10;  ///< number k >= 1 of the degrees of the strain that are integrated
};

/// The part of the tension that grows as long as there is strain (an augmented Lagrangian; a controller's integral
/// part):
///
///     dZ/dt = r F_k[s],  sigma = sigma0 (tension law of s + Z),  s = ln(dA/dA0),
///
/// F_k keeping the degrees n < k. Where the state is steady the strain of these degrees vanishes, and Z sigma0 is the
/// tension of an inextensible membrane; the elastic tension alone holds it only by a steady strain sigma/sigma0. The
/// strain decays with the rate r, so that 1/r should be short beside the times of the flow, and r dt small beside one.
/// The degrees that are left out hold noise of the grid, which must not be summed up.
class VESIFLOW_VESICLE_EXPORT IntegralTension {
 public:
  /// Degrees beyond the latitudes of the grid mean all of them.
  /// \throws std::invalid_argument unless rate is finite and >= 0 and degrees >= 1.
  IntegralTension(const SphereGrid& grid, const IntegralTensionParameters& parameters);

  /// Z += dt r F_k[s].
  /// \param strain s, shape (markers).
  /// \param multiplier Z, shape (markers).
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error if the strain is not finite (Z is then as it was).
  void advance(const ScalarField& strain, double dt, ScalarField& multiplier);

  /// sum Z (dA - dA0): times sigma0 the energy of which the force of sigma0 Z is minus the derivative at fixed Z.
  /// \throws std::invalid_argument for a wrong size.
  static double energy(const Surface& surface, const ScalarField& target_areas, const ScalarField& multiplier);

 private:
  double rate_;
  SphericalHarmonics harmonics_;
  Coefficients coefficients_;
  ScalarField smooth_strain_;
};

}  // namespace vesiflow::vesicle
