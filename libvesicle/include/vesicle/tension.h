// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Elastic energy of a surface element with target area dA0 and area dA = J dA0, and the tension sigma = dE/dA.
enum class TensionLaw {
  logarithmic,  ///< E = (sigma0/2) (ln J)^2 dA0, sigma = sigma0 (ln J) / J: Eq. (31)
  linear,       ///< E = (sigma0/2) (J - 1)^2 dA0, sigma = sigma0 (J - 1): a spring
};

/// How the force of a tension is discretised. Both are the same for a smooth tension.
enum class TensionForm {
  divergence,  ///< F = div(sigma P), Eq. (20)

  /// F = grad sigma - 2 sigma H n, Eq. (6): errors of sigma unbalance it, so that runs with a weak mesh filter blow up
  /// (Section 4.2 of the paper)
  non_divergence,
};

/// What the force of the tension depends on.
struct TensionParameters {
  double sigma0 = 600;                         ///< stiffness, finite and >= 0
  TensionLaw law = TensionLaw::logarithmic;    ///< how tension follows from strain
  TensionForm form = TensionForm::divergence;  ///< how the force is discretised
};

/// Elastic tension that keeps every surface element near its target area. The ratio J is taken of cell areas dA_ij,
/// which is the ratio of the area elements |X_theta x X_phi|.
class VESIFLOW_VESICLE_EXPORT TensionForce {
 public:
  /// \throws std::invalid_argument unless sigma0 is finite and >= 0.
  explicit TensionForce(const TensionParameters& parameters);

  const TensionParameters& parameters() const { return parameters_; }  ///< the parameters that were given

  /// Tension at the markers for target cell areas of shape (markers).
  /// \throws std::invalid_argument for a wrong number of target areas, or one that is not finite and > 0.
  void evaluate(const Surface& surface, const ScalarField& target_areas, ScalarField& tension) const;

  /// The same for a strain s = ln J that is a field of its own, shape (markers).
  void evaluate(const ScalarField& strain, ScalarField& tension) const;

  /// Adds F_sigma to `force`, shape (markers, 3), force per unit area.
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error if the tension is not finite (force is as it was).
  void add_to(const Surface& surface, const ScalarField& tension, VectorField& force);

  /// Elastic energy, of which F_sigma is minus the derivative.
  /// \throws std::invalid_argument as evaluate.
  double energy(const Surface& surface, const ScalarField& target_areas) const;

 private:
  TensionParameters parameters_;
  VectorField force_;
};

}  // namespace vesiflow::vesicle
