// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"

namespace vesiflow::vesicle {

class Surface;

/// Share of Lap H that may be unresolved before a warning is due.
inline constexpr double default_resolution_tolerance = 0.05;

/// How the energy of fields on the sphere is spread over the degrees of their expansion, and how fast it falls.
class VESIFLOW_VESICLE_EXPORT Spectrum {
 public:
  /// Spectrum of all fields together.
  /// \throws std::invalid_argument for fewer than four degrees or an energy that is not finite.
  explicit Spectrum(const Coefficients& coefficients);

  int degrees() const { return static_cast<int>(amplitude_.size()); }  ///< number of degrees

  /// Square root of the energy of each degree, sum_m |f_n^m|^2 over all fields and orders: shape (degrees).
  const std::vector<double>& amplitude() const { return amplitude_; }

  /// r >= 0 of the law A exp(-r n) that the amplitudes of the upper half of the degrees follow (those above round-off;
  /// least squares in the logarithm of the larger of two neighbours, since symmetric shapes lack every other degree).
  /// 0: no decay.
  double decay_rate() const { return decay_rate_; }

  /// Amplitude of a degree by that law.
  double extrapolated(double degree) const;

  /// Share of the surface Laplacian that degrees from `degrees` on would add by that law:
  ///
  ///     sqrt(sum_{n >= degrees} [n (n+1) a_n]^2 / sum_{n < p} [(1 + n (n+1)) a_n]^2).
  ///
  /// Infinite if the spectrum does not decay, 0 if it is zero.
  double laplacian_tail(double degrees) const;

 private:
  void fit_tail();

  std::vector<double> amplitude_;
  double log_amplitude_ = 0;  // of the fitted law at degree 0
  double decay_rate_ = 0;
  double laplacian_scale_ = 0;
};

/// Spectrum of the mean curvature at the markers: what the bending force needs resolved. (The positions alone do not
/// tell: an ellipsoid is of degree one.)
VESIFLOW_VESICLE_EXPORT Spectrum mean_curvature_spectrum(const Surface& surface);

/// Fraction of the energy of the position coefficients (degrees n >= 1) in the top third of the degrees, n >=
/// 2N/3. Near 0 for a resolved shape; growth announces loss of resolution.
VESIFLOW_VESICLE_EXPORT double spectrum_tail(const Surface& surface);

/// How well N latitudes resolve a shape, by the degrees of its mean curvature that are more than the round-off of its
/// positions.
struct Resolution {
  int latitudes = 0;  ///< N, of the mesh

  /// Share of Lap H that lies beyond degree N, see Spectrum::laplacian_tail.
  double unresolved = 0;
  /// Smallest multiple of 8 latitudes that leaves less than the tolerance unresolved; 0 if that is not below 512, the
  /// largest number supported.
  int needed_latitudes = 0;
  double tolerance = 0;  ///< share of Lap H that may be unresolved

  bool sufficient() const { return unresolved <= tolerance; }  ///< whether the tolerance is met
};

/// Resolution of a surface at its last geometry.
/// \throws std::invalid_argument unless tolerance > 0.
VESIFLOW_VESICLE_EXPORT Resolution resolution(const Surface& surface, double tolerance = default_resolution_tolerance);

/// One sentence for people, e.g. "the shape needs N_theta >= 48 (it has 32): 4 % of ..."; empty if the resolution is
/// sufficient.
VESIFLOW_VESICLE_EXPORT std::string resolution_warning(const Resolution& resolution);

}  // namespace vesiflow::vesicle
