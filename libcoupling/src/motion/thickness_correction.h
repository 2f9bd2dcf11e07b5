// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "coupling/delta_kernel.h"
#include "vesicle/membrane.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {

/// Adds to the velocity of a membrane what the width of the delta function takes from it (coupling.thickness_correction): the
/// difference between the exact answer of a sphere of the membrane's area to forces and its answer by way of the grid
/// (SphereResponse). Of forces in e+ and e- of degree n that difference is
///   diag(r_{n+1}^+, r_{n-1}^-) + g_n t t^T,   g_n = mixed (2n+1)/sqrt(n (n+1)),
/// where t is the direction of a force along the sphere: g is the kink in the velocity that interpolation averages over, c h F/mu
/// to leading order (first order in h, thickening() of coupling/delta_kernel.h), and r, of second order, is mostly what
/// is smoothed out along the sphere, once by spreading and once by interpolation: to leading order
///   r_l^- = alpha h^2 (l + 2)/(2 R),   r_l^+ = alpha h^2 (l - 1)/(2 R),   alpha = m_t + (m_n - m_t)/5 - 1/20,
/// with the second moments m of the delta function along a component and across (the last term is the grid's Laplacian; derived in
/// tests/simulation/thickness_correction_test.cpp). On a membrane of any shape
///   - r multiplies the Cartesian components of the force per area, all but the mean of its normal part, which is a
///     pressure, by their degree; r_l is the mean of r_l^+ (2l - 1 harmonics) and r_l^- (2l + 3 harmonics);
///   - g multiplies the degrees of the tension, whose surface gradient is added.
/// So the added velocity is as smooth as the interpolated one. (Degrees of the normal force times the normal would fit the sphere
/// exactly, but have components of degrees that the membrane does not resolve: its mesh then creeps.) Degrees are faded out
/// by exp(-a^4), a = log2 of exact over immersed answer to a normal force: where less than half of the answer arrives, the
/// correction is as uncertain as what it corrects.
class ThicknessCorrection {
 public:
  /// \param viscosity mean of the two on the sides of the membrane
  ThicknessCorrection(const vesicle::Membrane& membrane, DeltaKernel kernel, double spacing, double viscosity);

  /// Adds to the interpolated velocity (markers x 3) what is lacking of the answer to `force`, all that acts on the fluid per
  /// area (markers x 3), with the membrane's tension as last computed.
  void add_to(const vesicle::Membrane& membrane, const vesicle::VectorField& force, vesicle::VectorField& velocity);

  /// Degrees that are corrected, from 0 on: of the others, less than about a quarter of the answer arrives.
  int degrees() const { return static_cast<int>(along_.size()); }

  /// r_l and g_n, faded out, over the viscosity.
  double smoothing(int degree) const { return smoothing_[static_cast<std::size_t>(degree)]; }
  double along(int degree) const { return along_[static_cast<std::size_t>(degree)]; }

 private:
  struct Factors {
    std::vector<double> smoothing, along;  // per degree
  };
  static Factors factors(const vesicle::Membrane& membrane, DeltaKernel kernel, double spacing, double viscosity);
  ThicknessCorrection(const vesicle::Membrane& membrane, Factors factors);

  std::vector<double> smoothing_, along_;
  vesicle::SphericalHarmonics harmonics_;
  vesicle::Coefficients coefficients_;  // of the force and the tension
  Eigen::ArrayXXd values_;
  vesicle::ScalarField normal_force_, potential_;
  vesicle::VectorField gradient_;
};

}  // namespace vesiflow::coupling
