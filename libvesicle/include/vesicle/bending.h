#pragma once

#include "vesicle/curvature_laplacian.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// (1/2) int H^2 dA: 2 pi on any sphere. The bending energy of the model is 1/Ca times this.
double bending_energy(const Surface& surface);

/// Bending force per unit area, Eq. (21): F_b = 1/(2 Ca) [Lap H + 2 H (H^2 - K)] n, minus the derivative of
/// bending_energy / Ca. Ca is the paper's mu_o r^3 / (c_b t_c); with Helfrich's modulus kappa = c_b / 4 the
/// literature's capillary number is 4 Ca.
class BendingForce {
 public:
  /// @throws std::invalid_argument unless capillary_number > 0 and latitudes >= 4.
  BendingForce(int latitudes, double capillary_number, LaplacianForm form);

  /// Adds F_b to `force`, shape (markers, 3), force per unit area.
  void add_to(const Surface& surface, VectorField& force);

 private:
  double stiffness_;
  CurvatureLaplacian laplacian_;
  ScalarField normal_force_;
};

}  // namespace vesiflow::vesicle
