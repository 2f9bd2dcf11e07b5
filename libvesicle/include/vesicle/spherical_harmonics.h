#pragma once

#include <memory>

#include "vesicle/coefficients.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Scalar spherical-harmonic transforms of several real fields at once, Eqs. (23)-(30) of the paper in the
/// fully normalised complex convention
///   f(theta, phi) = sum_{n<p} [ f_n^0 Y_n^0 + 2 Re sum_{m=1}^n f_n^m Y_n^m ],
///   Y_n^m = P_n^m(cos theta) exp(i m phi),  int |Y_n^m|^2 = 1 over the unit sphere,
/// with P_n^m > 0 next to the north pole for all m >= 0 (no Condon-Shortley phase), so Y_0^0 = 1/sqrt(4 pi).
///
/// Fields are columns of arrays of shape (grid.size(), fields); derivatives are plain partial derivatives
/// with respect to theta and phi at the grid nodes. Derivatives of P_n^m use
///   dP_n^m/dtheta = 1/2 [ sqrt((n+m)(n-m+1)) P_n^{m-1} - sqrt((n-m)(n+m+1)) P_n^{m+1} ]
/// (once or twice) and so never divide by sin(theta). Tables are built in extended precision.
///
/// The number of degrees p is free of the grid:
/// - p <= latitudes: analysis is exact for fields of degree < p, and is the discrete adjoint of synthesis;
/// - p > latitudes: synthesis and derivatives are still the exact values of the expansion at the nodes (orders beyond
///   the longitudes' Nyquist order are folded onto the Fourier mode they equal there); analysis is refused.
/// Coefficients of more than p degrees may be given: the transform reads those with n < p, which makes it a
/// sharp low-pass filter.
///
/// FFTW plans are made by estimate and not by measurement: measured plans differ from process to process and
/// a restarted run would then not repeat the uninterrupted one bit for bit.
///
/// A transform owns its tables and work space: it allocates on the first use of each function and when it
/// first meets a larger number of fields, never again, and must not be used by two threads at once.
class SphericalHarmonics {
 public:
  using Input = Eigen::Ref<const Eigen::ArrayXXd>;
  using Output = Eigen::Ref<Eigen::ArrayXXd>;

  /// Degrees 0 <= n < degrees on the given grid; work space for max_fields fields is allocated at once.
  /// @throws std::invalid_argument unless degrees >= 1 and max_fields >= 1.
  SphericalHarmonics(int degrees, const SphereGrid& grid, int max_fields = 3);
  ~SphericalHarmonics();
  SphericalHarmonics(SphericalHarmonics&&) noexcept;
  SphericalHarmonics& operator=(SphericalHarmonics&&) noexcept;

  int degrees() const;
  const SphereGrid& grid() const;

  /// Coefficients of `values`, Eqs. (24)-(25); resizes `coefficients` to (degrees, fields).
  /// @throws std::invalid_argument if values has not grid.size() rows, std::logic_error if degrees >
  /// latitudes.
  void analysis(const Input& values, Coefficients& coefficients) const;

  /// Values at the nodes, Eq. (23).
  /// @throws std::invalid_argument if an output is not (grid.size(), fields) or the coefficients have too few
  /// degrees. The same holds for the functions below.
  void synthesis(const Coefficients& coefficients, Output values) const;

  /// First derivatives, Eqs. (26)-(27).
  void gradient(const Coefficients& coefficients, Output theta, Output phi) const;

  /// Second derivatives, Eqs. (28)-(30).
  void second_derivatives(const Coefficients& coefficients, Output theta_theta, Output theta_phi, Output phi_phi) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vesiflow::vesicle
