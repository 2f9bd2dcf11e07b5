// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "vesicle/export.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"
#include "vesicle/upsampling.h"

namespace vesiflow::vesicle {

/// How the surface Laplacian (Laplace-Beltrami operator) is discretised. f is a scalar with coefficients of degree
/// < p; the fine grid has p latitudes.
enum class LaplacianForm {
  /// Cartesian surface gradient of f on the fine grid, Eq. (11): three smooth scalars; transform with p degrees; Eq.
  /// (12). Spectrally accurate.
  cartesian,
  /// g^{ab} (f_ab - Gamma^c_ab f_c), Gamma^c_ab = X^c . X_ab, from second derivatives of f: no product is transformed
  /// again, so it is as accurate as f is and cheapest, but cancels near the poles: round-off grows like 1/sin^2(theta).
  christoffel,
  /// Eq. (14) of the paper: (1/W) [(W grad f . X^theta)_theta + (W grad f . X^phi)_phi] by scalar transforms. The
  /// fluxes are not smooth on the sphere, so the error stalls (0.2 on the 1:2:4 ellipsoid, where max |Lap H| = 100).
  paper,
};

/// How a surface Laplacian is computed.
struct LaplacianOptions {
  LaplacianForm form = LaplacianForm::cartesian;  ///< the formula
  Upsampling upsampling = Upsampling::twice;      ///< how much finer the fine grid is

  /// Projects the result to the N degrees of the surface. What a field of N degrees can hold, but for Lap H at the
  /// markers its error is that of the projection, far above that of Lap H itself.
  bool truncated = false;

  /// The paper's upsampling algorithm (Section 3.2): Eq. (14) on 2N latitudes, truncated.
  static LaplacianOptions of_the_paper() { return {LaplacianForm::paper, Upsampling::twice, true}; }
};

/// Lap_Gamma of scalar fields at the markers of surfaces on one grid. Nothing allocates after the first call, but where
/// Upsampling::automatic meets a factor for the first time. One thread at a time.
///
/// Max error of Lap H, N = 32, 64, 128, cartesian, twice, not truncated: 7.5e-3, 5.0e-9, 1.7e-8 on the 1:2:4 ellipsoid
/// (paper: 4.2, 0.23, 0.22), see validation/studies/table1.md.
class VESIFLOW_VESICLE_EXPORT LaplaceBeltrami {
 public:
  /// For surfaces on that grid.
  explicit LaplaceBeltrami(const SphereGrid& grid, const LaplacianOptions& options = {});
  ~LaplaceBeltrami();
  LaplaceBeltrami(LaplaceBeltrami&&) noexcept;             ///< what is moved from can only be assigned to or destroyed
  LaplaceBeltrami& operator=(LaplaceBeltrami&&) noexcept;  ///< takes over the work space of another one

  const LaplacianOptions& options() const;  ///< the options that were given

  /// Laplacian of a scalar given at the markers, of which the degrees below N are used.
  /// \param scalar shape (markers).
  /// \param result shape (markers), resized if needed.
  /// \throws std::invalid_argument if the surface lives on another grid, or the scalar has another size.
  void apply(const Surface& surface, const ScalarField& scalar, ScalarField& result) const;

  /// Laplacian of the mean curvature, with H computed on the fine grid from the coefficients of the positions.
  void of_mean_curvature(const Surface& surface, ScalarField& result) const;

  /// Factor used by the last call: 1, 1.5 or 2.
  double last_factor() const;  ///< factor of the upsampling in the last call: 1, 1.5 or 2

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vesiflow::vesicle
