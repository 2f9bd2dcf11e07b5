#pragma once

#include <vector>

#include "coupling/delta_kernel.h"
#include "vesicle/membrane.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {

/// What the width of the delta function across a membrane takes from its velocity (coupling.thickness_correction). Of a plane
/// sheet with force per area F e^{ikx} on it in Stokes flow of viscosity mu, spread and interpolated across the sheet with a
/// Gaussian of second moment m h^2, x = k h sqrt(m), e = exp(x^2) erfc(x), the velocity is
///   1/(4 mu k) [(1 + 2 x^2) e - 2 x/sqrt(pi)] F   for F along the sheet and k,
///   1/(4 mu k) [(1 - 2 x^2) e + 2 x/sqrt(pi)] F   for F normal to it,
/// and 1/(4 mu k) F, both, if h = 0. The difference is added: c h F/mu along (a membrane that is thick by this, first order in
/// h, thickening() of coupling/delta_kernel.h) and m h^2 k F/(4 mu) across, to leading order. m = pi c^2 gives each kernel
/// its c. A degree n of the tension sigma, of which P F is the surface gradient, and of the normal force is taken as
/// k = (n + 1/2)/R, R of the sphere of the membrane's area; degrees are faded out by exp(-(k h)^4), as on the scale of the grid the
/// correction is as wrong as what it corrects.
class ThicknessCorrection {
 public:
  /// \param viscosity mean of the two on the sides of the membrane
  ThicknessCorrection(const vesicle::Membrane& membrane, DeltaKernel kernel, double spacing, double viscosity);

  /// Adds to the interpolated velocity (markers x 3) what the forces of the membrane, as last computed, lack.
  void add_to(const vesicle::Membrane& membrane, vesicle::VectorField& velocity);

  /// Missing velocity per force of a degree n, along the membrane (gradients) and normal to it.
  double along(int degree) const { return along_[static_cast<std::size_t>(degree)]; }
  double normal(int degree) const { return normal_[static_cast<std::size_t>(degree)]; }

 private:
  void scale_degrees(const std::vector<double>& factors);

  vesicle::SphericalHarmonics harmonics_;
  std::vector<double> along_, normal_;  // per degree
  vesicle::Coefficients coefficients_;
  vesicle::ScalarField values_;
  vesicle::VectorField gradient_;
};

}  // namespace vesiflow::coupling
