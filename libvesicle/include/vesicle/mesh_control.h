// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "vesicle/export.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// How the marker velocity is smoothed in Step 4 of Section 3.3; F_k keeps the degrees n < k.
enum class FilterOrder {
  /// U~ = (n . F_normal U) n + (I - n n^T) F_tangential U. U is smooth though its normal and tangential parts
  /// are not.
  velocity_first,
  /// U~ = F_normal [(U . n) n] + F_tangential [(I - n n^T) U]: the other reading of the paper's text. Unstable for
  /// elongated shapes (reduced volume 0.8), since the parts have slowly decaying spectra.
  components,
};

/// The velocity filter that keeps the marker mesh smooth. The normal velocity is only dealiased; the
/// tangential one, which does not change the shape, keeps few degrees.
class VESIFLOW_VESICLE_EXPORT MeshFilter {
 public:
  /// Numbers of degrees kept; those beyond the mesh's `latitudes` degrees mean all of them.
  /// \throws std::invalid_argument unless both are >= 1.
  MeshFilter(const SphereGrid& grid, FilterOrder order, int normal_degrees, int tangential_degrees);

  /// Filters a marker velocity.
  /// \param velocity U, shape (markers, 3).
  /// \param filtered U~, shape (markers, 3), resized if needed; must not be `velocity`.
  /// \throws std::invalid_argument if velocity has the wrong size or the surface lives on another grid.
  /// \throws std::domain_error if velocity is not finite (filtered is then as it was).
  void apply(const Surface& surface, const VectorField& velocity, VectorField& filtered);

 private:
  void filter_velocity(const VectorField& normal, const VectorField& velocity, VectorField& filtered);
  void filter_components(const VectorField& normal, const VectorField& velocity, VectorField& filtered);

  FilterOrder order_;
  SphericalHarmonics normal_harmonics_;
  SphericalHarmonics tangential_harmonics_;
  Coefficients coefficients_;
  VectorField part_;
};

/// Which velocity stands for the membrane's own in the slip of the mesh.
enum class SlipReference {
  /// U as it is interpolated from the fluid, as in the paper. Its high degrees are noise of the fluid grid, which then
  /// builds up in the target areas.
  interpolated,
  /// F_{2N/3} U: what dealiasing removes from U moves neither mesh nor membrane.
  dealiased,
};

/// Target areas of the markers, which follow the slip of the mesh relative to the membrane (Step 5 of
/// Section 3.3).
class VESIFLOW_VESICLE_EXPORT TargetAreaUpdate {
 public:
  /// For surfaces on that grid.
  TargetAreaUpdate(const SphereGrid& grid, SlipReference reference);

  /// One step of Eqs. (33) and (32) with the geometry before the move:
  ///
  ///     ln dA0 += dt div[ P (U~ - U) ], then dA0 scaled so that it sums to total_area.
  ///
  /// \param velocity U, shape (markers, 3).
  /// \param filtered U~, shape (markers, 3).
  /// \param target_areas dA0, shape (markers).
  /// \throws std::invalid_argument for a wrong size or a surface on another grid.
  /// \throws std::domain_error if a result is not finite and > 0 (target_areas is as it was).
  void apply(const Surface& surface, const VectorField& velocity, const VectorField& filtered, double dt,
             double total_area, ScalarField& target_areas);

 private:
  SphereGrid grid_;
  std::optional<SphericalHarmonics> dealiasing_;
  Coefficients coefficients_;
  VectorField slip_;
  ScalarField normal_slip_, slip_divergence_;
};

}  // namespace vesiflow::vesicle
