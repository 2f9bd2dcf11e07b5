// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Gauss-Legendre colatitudes by equispaced longitudes on the parameter sphere, poles excluded:
///
///     theta_j with cos(theta_j) the nodes of Gauss-Legendre quadrature, 0 < theta_0 < ... < theta_{N-1} < pi,
///     phi_i = 2 pi i / N_phi, i = 0 .. N_phi - 1, N_phi = 2 N unless stated, always even and >= 2 N - 1.
///
/// sum_ij w_j dphi f_ij integrates spherical harmonics of degree up to 2N - 1 exactly over the unit sphere.
///
/// Nodes come from Newton's method in theta (not the arccosine of a rounded cosine) in extended precision:
/// the geometry near the poles inherits the relative accuracy of sin(theta).
class VESIFLOW_VESICLE_EXPORT SphereGrid {
 public:
  /// Most latitudes: room for the finer grids on which products of the largest Surface are formed.
  static constexpr int largest_latitudes = 4096;
  static constexpr int largest_longitudes = 16384;  ///< most longitudes

  /// The grid of that number of latitudes, with N_phi = 2 latitudes.
  /// \throws std::invalid_argument unless 2 <= latitudes <= 4096.
  explicit SphereGrid(int latitudes);
  /// The grid with these numbers of latitudes and longitudes.
  /// \throws std::invalid_argument unless 2 <= latitudes <= 4096, and longitudes is even, >= 2 latitudes and <= 16384.
  SphereGrid(int latitudes, int longitudes);

  int latitudes() const { return latitudes_; }                                  ///< N
  int longitudes() const { return longitudes_; }                                ///< N_phi
  Eigen::Index size() const { return Eigen::Index{latitudes_} * longitudes_; }  ///< number of markers

  /// Whether both numbers are the same.
  friend bool operator==(const SphereGrid& a, const SphereGrid& b) {
    return a.latitudes_ == b.latitudes_ && a.longitudes_ == b.longitudes_;
  }

  /// Marker number of longitude i and colatitude j.
  Eigen::Index index(int i, int j) const { return Eigen::Index{j} * longitudes() + i; }

  double longitude_spacing() const;                                  ///< dphi = 2 pi / N_phi
  double longitude(int i) const { return i * longitude_spacing(); }  ///< phi_i

  /// theta_j, shape (latitudes).
  const ScalarField& colatitude() const { return colatitude_; }
  const ScalarField& sin_colatitude() const { return sin_; }  ///< sin(theta_j), shape (latitudes)
  const ScalarField& cos_colatitude() const { return cos_; }  ///< cos(theta_j), shape (latitudes)

  /// Gauss weights w_j, shape (latitudes), which sum to 2.
  const ScalarField& weight() const { return weight_; }

  /// dtheta_j dphi = w_j dphi / sin(theta_j), shape (latitudes): multiplies |X_theta x X_phi| to give the area of a
  /// marker's cell.
  const ScalarField& parameter_measure() const { return parameter_measure_; }

 private:
  int latitudes_;
  int longitudes_;
  ScalarField colatitude_, sin_, cos_, weight_, parameter_measure_;
};

}  // namespace vesiflow::vesicle
