// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vesicle/export.h"
#include "vesicle/mesh_energy.h"
#include "vesicle/mesh_quality.h"
#include "vesicle/point_evaluation.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// When a mesh calls for redistribution: beyond either limit.
struct RedistributionLimits {
  double aspect_ratio = 5;      ///< largest MeshQuality::aspect_ratio
  double spectrum_tail = 1e-6;  ///< largest MeshQuality::spectrum_tail

  /// Whether a mesh is beyond a limit.
  bool passed_by(const MeshQuality& quality) const {
    return quality.aspect_ratio > aspect_ratio || quality.spectrum_tail > spectrum_tail;
  }
};

/// What redistribute() did.
struct RedistributionReport {
  bool moved = false;        ///< whether there is a new mesh
  MeshQuality before,        ///< quality of the old mesh
      after;                 ///< quality of the new mesh; as before unless moved
  double energy_before = 0;  ///< mesh energy E of the old mesh
  double energy_after = 0;   ///< mesh energy E of the new mesh
  int iterations = 0;        ///< Gauss-Newton steps
  double truncation = 0;     ///< greatest distance by which keeping fewer degrees took a marker off the old surface
};

/// Moves the markers of a mesh along its surface, leaving the shape alone: the surface X(x), x on the unit sphere,
/// becomes X(y(x)) with y a smooth one-to-one map of the sphere chosen to minimise the mesh energy E of X o y
/// (mesh_energy.h). (Rahimian, Veerapaneni, Zorin & Biros, J. Comput. Phys. 298 (2015) 766, move markers by pseudo-time
/// steps down such an energy; here by Gauss-Newton steps.)
///
/// One step finds the tangential displacement w that minimises E to second order,
///
///     P (A + mu) P w = -P A X,  A = diag(mesh_energy_weight(n)), P = I - n n^T,
///
/// by a few preconditioned conjugate gradients, pulls it back to the sphere and moves y, with step halving until E
/// falls and the Jacobian of y stays positive. Markers are always the original expansion evaluated at y
/// (PointEvaluation), so they lie on the original surface to round-off; what changes the shape is only the truncation
/// of X o y.
///
/// With kept_degrees < N the new positions keep that many degrees. A simulation whose marker velocity has n < 2N/3
/// needs it: what lies above moves with nothing, and noise that redistribution shifts there would stay for good and
/// pile up.
class VESIFLOW_VESICLE_EXPORT MeshRedistribution {
 public:
  /// For meshes with that number of latitudes.
  /// \param kept_degrees degrees of the new positions; 0 for all of them.
  /// \throws std::invalid_argument unless latitudes >= 4 and 0 <= kept_degrees <= latitudes.
  explicit MeshRedistribution(int latitudes, int kept_degrees = 0);

  /// Looks for a better mesh of the surface, which must have the same number of latitudes. There is none (moved =
  /// false) if E cannot be lowered by a tenth, is that of rounding, or if the surface is so poorly resolved that its
  /// volume or area would change by more than one per cent.
  RedistributionReport redistribute(const Surface& surface);

  /// New markers, on the surface (but for report.truncation) given to the last redistribute(); that surface's own if it
  /// did not move.
  const VectorField& positions() const { return surface_.positions(); }

  /// The map y, unit vectors at the nodes.
  const VectorField& map() const { return map_; }

  /// Carries a smooth material field given at the old markers, shape (markers), to the new ones: field(y(x)).
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error if the field is not finite (and as it was).
  void carry(ScalarField& field) const;

 private:
  double energy() const { return mesh_energy(surface_.position_coefficients()); }
  void find_displacement();
  void pull_back();
  bool is_one_to_one(const VectorField& map);
  bool move(const Coefficients& original);
  double truncate();
  double inner(const VectorField& a, const VectorField& b) const;

  Surface surface_;  // X o y
  SphericalHarmonics smoothing_;
  std::optional<SphericalHarmonics> truncation_;
  PointEvaluation evaluation_;
  MeshEnergyDescent descent_;
  VectorField map_, map_theta_, map_phi_, trial_map_, trial_positions_;
  VectorField displacement_, residual_, direction_, product_, preconditioned_, map_step_, old_positions_;
  mutable Coefficients coefficients_;
};

}  // namespace vesiflow::vesicle
