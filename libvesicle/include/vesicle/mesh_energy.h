// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/coefficients.h"
#include "vesicle/export.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// a_n = (n - 1) n (n + 1) (n + 2) of the mesh energy, for degree n >= 0 (0 for n = 0 and 1).
VESIFLOW_VESICLE_EXPORT double mesh_energy_weight(int degree);

/// E = 1/2 sum_{n,m} a_n |X_n^m|^2 of the positions X: which of the meshes of one shape is good. It is zero for a
/// linear image of the sphere, the usual mesh of an ellipsoid, and weighs high degrees, as a_n = (Lap + 2) Lap: least
/// is the mesh that needs the fewest degrees for the shape.
VESIFLOW_VESICLE_EXPORT double mesh_energy(const Coefficients& positions);

/// Ways down the mesh energy along a surface, which change the mesh and leave the shape. With P = I - n n^T, A =
/// diag(a_n) and M = diag(m_n), all applied to the degrees of the transform that is given, which must be on the grid of
/// the surface. Fields have the shape (markers, 3); results are resized if needed. Nothing allocates after the first
/// call. One thread at a time.
///
/// All functions throw std::invalid_argument for a transform on another grid than the surface, or a field of a wrong
/// size.
class VESIFLOW_VESICLE_EXPORT MeshEnergyDescent {
 public:
  /// m_n = a_max(n, lowest_degree) + damping, which is to be near a_n and > 0: E does not see the degrees 0 and 1.
  struct Metric {
    int lowest_degree = 0;  ///< the degrees below it have the weight of this one
    double damping = 0;     ///< what is added to all weights
  };

  /// \throws std::invalid_argument unless damping is finite and >= 0, and > 0 or lowest_degree >= 2.
  explicit MeshEnergyDescent(const Metric& metric);

  /// -P A X: minus the derivative of E by tangential displacements.
  void force(const SphericalHarmonics& transform, const Surface& surface, VectorField& result);

  /// P (A + damping) of a tangential field: the second derivative, damped. result must not be `field`.
  void apply_second_derivative(const SphericalHarmonics& transform, const Surface& surface, const VectorField& field,
                               VectorField& result);

  /// P M^-1 of a tangential field, which preconditions that. result may be `field`.
  void precondition(const SphericalHarmonics& transform, const Surface& surface, const VectorField& field,
                    VectorField& result);

  /// -P M^-1 P A X: the direction of steepest descent in the norm of M. With M near A all degrees come down at about
  /// the same rate.
  void direction(const SphericalHarmonics& transform, const Surface& surface, VectorField& result);

 private:
  template <class Factor>
  void scale(const SphericalHarmonics& transform, const Surface& surface, const VectorField& field,
             const Factor& factor, VectorField& result);
  void make_tangential(const Surface& surface, VectorField& field);

  Metric metric_;
  Coefficients coefficients_;
  ScalarField normal_part_;
};

}  // namespace vesiflow::vesicle
