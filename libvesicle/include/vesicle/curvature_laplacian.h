#pragma once

#include <memory>

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// How the surface Laplacian of the mean curvature is discretised.
enum class LaplacianForm {
  /// H on the grid of 2N latitudes from the coefficients of X; its Cartesian surface gradient there (three smooth
  /// scalars), Eq. (11); transform with 2N degrees; Eq. (12) at the markers. Spectrally accurate.
  cartesian,
  /// The paper's upsampling algorithm (Section 3.2): Eq. (14) on the grid of 2N latitudes, then truncated to N degrees. The
  /// flux of Eq. (14) is not smooth on the sphere, so the error stalls (0.2 on the 1:2:4 ellipsoid, where
  /// max |Lap H| = 100).
  paper,
};

/// Evaluates Lap_Gamma H at the markers.
class CurvatureLaplacian {
 public:
  /// @throws std::invalid_argument unless latitudes >= 4.
  CurvatureLaplacian(int latitudes, LaplacianForm form);
  ~CurvatureLaplacian();
  CurvatureLaplacian(CurvatureLaplacian&&) noexcept;
  CurvatureLaplacian& operator=(CurvatureLaplacian&&) noexcept;

  /// result: shape (markers), resized if needed.
  /// @throws std::invalid_argument if the surface has other latitudes, std::domain_error if the refined
  /// surface is degenerate.
  void evaluate(const Surface& surface, ScalarField& result) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vesiflow::vesicle
