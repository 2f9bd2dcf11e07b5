// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/laplace_beltrami.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// (1/2) int (H - H0)^2 dA with H the mean of the principal curvatures: 2 pi on any sphere for H0 = 0. The bending
/// energy of the model is 1/Ca times this. H0 is the spontaneous curvature in the same sense; Helfrich's c_0 is 2 H0.
/// \throws std::invalid_argument unless H0 is finite.
VESIFLOW_VESICLE_EXPORT double bending_energy(const Surface& surface, double spontaneous_curvature = 0);

/// What the bending force depends on.
struct BendingParameters {
  double capillary_number = 2.5;     ///< Ca > 0 of Eq. (21)
  double spontaneous_curvature = 0;  ///< H0, finite, in 1/effective radius
  LaplacianOptions laplacian = {};   ///< how Lap H is discretised
};

/// Bending force per unit area,
///
///     F_b = (1/Ca) [ (1/2) Lap H + (H - H0) (H^2 - K + H0 H) ] n,
///
/// minus the derivative of bending_energy / Ca; Eq. (21) for H0 = 0. Ca is the paper's mu_o r^3 / (c_b t_c); with
/// Helfrich's modulus kappa = c_b / 4 the literature's capillary number is 4 Ca.
class VESIFLOW_VESICLE_EXPORT BendingForce {
 public:
  /// \throws std::invalid_argument for a parameter out of range.
  BendingForce(const SphereGrid& grid, const BendingParameters& parameters);

  const BendingParameters& parameters() const { return parameters_; }  ///< the parameters that were given

  /// Adds F_b to `force`, shape (markers, 3), force per unit area.
  /// \throws std::invalid_argument if the surface lives on another grid or the force has another size.
  void add_to(const Surface& surface, VectorField& force);

  /// bending_energy / Ca, with the spontaneous curvature.
  double energy(const Surface& surface) const;

 private:
  BendingParameters parameters_;
  LaplaceBeltrami laplacian_;
  ScalarField normal_force_;
};

}  // namespace vesiflow::vesicle
