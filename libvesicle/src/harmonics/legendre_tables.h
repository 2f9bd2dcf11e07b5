// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "harmonics/panel_product.h"

namespace vesiflow::vesicle {

/// What a Legendre table holds: P_n^m(cos theta_j) or its first or second derivative in theta.
enum class LegendreKind { value = 0, first = 1, second = 2 };

/// Which way a table is packed: sums over degrees give values at latitudes, sums over latitudes give degrees. Quadrature is a
/// sum over latitudes with the functions times w_j 2 pi/N_phi. Weights of their own, rounded once for all functions of a
/// latitude, would leave errors of whole rings: seven times the error of the Laplacian of H at 128 latitudes.
enum class LegendreSum { over_degrees = 0, over_latitudes = 1, quadrature = 2 };

/// Number of degrees n = m + parity, m + parity + 2, ... below `degrees`.
constexpr int degree_count(int degrees, int m, int parity) {
  return (degrees - m - parity + 1) / 2;
}

/// Matrices of one kind for all orders m and both parities of n - m, on the northern half of a Gauss-Legendre
/// grid (equator included for an odd number of latitudes). P_n^m has the parity of n - m under north <->
/// south; the first derivative has the opposite one.
///
/// Near the pole high orders decay like sin(theta)^m. Of each order the leading latitudes (in fours) where no
/// function exceeds 1e-22 are left out: six orders of magnitude below the rounding of any field of that order, and six
/// per cent of the work at 128 latitudes, ten at 256. What is smaller than 1e-150 elsewhere is stored as zero: it would otherwise
/// breed denormal numbers, which are a hundred times slower.
class LegendreTable {
 public:
  /// The longitudes matter for quadrature only.
  LegendreTable(LegendreKind kind, LegendreSum sum, int degrees, int latitudes, int longitudes);

  /// Rows and columns: northern latitudes and degrees of order m for sums over degrees, else the reverse; the first
  /// latitude is first_latitude(m).
  const PanelMatrix& matrix(int m, int parity) const { return matrices_[m][parity]; }

  int first_latitude(int m) const { return first_latitudes_[m]; }

 private:
  std::vector<int> first_latitudes_;
  std::vector<std::array<PanelMatrix, 2>> matrices_;
  AlignedArray<double> data_;
};

/// The table of that description, made unless somebody has it. Safe to call from several threads.
std::shared_ptr<const LegendreTable> shared_legendre_table(LegendreKind kind, LegendreSum sum, int degrees,
                                                           int latitudes, int longitudes);

}  // namespace vesiflow::vesicle
