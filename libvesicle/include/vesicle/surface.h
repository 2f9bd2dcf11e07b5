// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "vesicle/export.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface_geometry.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// A closed surface of spherical topology given by its markers X_ij on a SphereGrid, with its geometry (Step
/// 1 of Section 3.3) and its surface calculus (Eqs. (11) and (12)). Outputs go to arrays of the caller, which
/// are resized when their size is wrong; with the right size nothing allocates. One thread at a time.
///
/// Only what is asked for is computed: update() computes the first form (tangents, normal, area), the curvatures follow
/// when they are first asked for. Lap H is a matter of its own, see LaplaceBeltrami.
class VESIFLOW_VESICLE_EXPORT Surface {
 public:
  /// Most latitudes; up to here the transforms are tested.
  static constexpr int largest_latitudes = 512;

  /// A surface on the grid with that number of latitudes.
  /// \throws std::invalid_argument unless 4 <= latitudes <= 512.
  explicit Surface(int latitudes);
  /// A surface on that grid.
  /// \throws std::invalid_argument unless it has 4 to 512 latitudes.
  explicit Surface(const SphereGrid& grid);
  ~Surface();
  Surface(Surface&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  Surface& operator=(Surface&&) noexcept;  ///< takes over the markers and the work space of another one

  /// Takes new marker positions, shape (markers, 3). Nothing below is meaningful before the first call. Asking here for
  /// curvatures that will be needed is a little faster than asking for them later.
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error for positions that are not finite (with the first such marker) or a degenerate mesh (see
  /// SurfaceGeometry). After a degenerate mesh nothing below is meaningful until an update succeeds, area and volume
  /// are NaN; after the other errors all is as it was.
  void update(const VectorField& positions, GeometryDetail detail = GeometryDetail::first_form);

  const SphereGrid& grid() const { return grid_; }  ///< the grid of the markers

  /// Transforms with degrees n < latitudes on this grid.
  const SphericalHarmonics& harmonics() const { return harmonics_; }

  const VectorField& positions() const { return positions_; }  ///< X_ij, shape (markers, 3)

  /// Those of X, three fields of N degrees.
  const Coefficients& position_coefficients() const { return coefficients_; }
  /// The geometry with what has been asked for so far.
  const SurfaceGeometry& geometry() const { return geometry_; }
  const SurfaceGeometry& geometry_with_curvature() const;  ///< the geometry with the curvatures

  const VectorField& normal() const { return geometry_.normal(); }                ///< outward unit normal n
  const VectorField& tangent_theta() const { return geometry_.tangent_theta(); }  ///< X_theta
  const VectorField& tangent_phi() const { return geometry_.tangent_phi(); }      ///< X_phi
  const ScalarField& area_element() const { return geometry_.area_element(); }    ///< |X_theta x X_phi|
  const ScalarField& mean_curvature() const { return geometry_with_curvature().mean_curvature(); }  ///< H

  /// Gaussian curvature K.
  const ScalarField& gaussian_curvature() const { return geometry_with_curvature().gaussian_curvature(); }

  /// dA_ij = |X_theta x X_phi|_ij w_j dphi / sin(theta_j); sums to area().
  const ScalarField& area_weight() const { return area_weight_; }

  double area() const { return area_; }  ///< area A

  /// Enclosed volume V = (1/3) sum X . n dA.
  double volume() const { return volume_; }

  /// sum f dA for a scalar field of shape (markers).
  /// \throws std::invalid_argument for a wrong size. So do all functions that follow.
  double integral(const ScalarField& field) const;
  /// sum F dA, component by component.
  Vector3 integral(const VectorField& field) const;
  /// sum U . n dA.
  double flux(const VectorField& field) const;

  /// Surface gradient, Eq. (11).
  void gradient(const ScalarField& scalar, VectorField& result) const;
  /// Surface divergence of any vector field, tangent or not, Eq. (12).
  void divergence(const VectorField& vector, ScalarField& result) const;
  /// max |div U| over the markers.
  /// \throws std::domain_error if the vectors are not finite.
  double max_divergence(const VectorField& vector) const;
  /// div(s P), P = I - n n^T, row by row with Eq. (12): the divergence form of Eq. (20). Six distinct fields.
  void projector_divergence(const ScalarField& scalar, VectorField& result) const;

 private:
  struct Work;

  SphereGrid grid_;
  SphericalHarmonics harmonics_;
  mutable SurfaceGeometry geometry_;  // the curvatures are computed on demand
  Coefficients coefficients_;
  VectorField positions_;
  ScalarField area_weight_;
  double area_ = 0;
  double volume_ = 0;
  std::unique_ptr<Work> work_;
};

}  // namespace vesiflow::vesicle
