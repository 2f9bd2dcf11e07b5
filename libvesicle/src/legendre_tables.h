#pragma once

#include <array>
#include <vector>

#include "panel_product.h"

namespace vesiflow::vesicle {

/// What a Legendre table holds: P_n^m(cos theta_j) or its first or second derivative in theta.
enum class LegendreKind { value = 0, first = 1, second = 2 };

/// Matrices of one kind for all orders m and both parities of n - m, on the northern half of a Gauss-Legendre
/// grid (equator included for an odd number of latitudes). P_n^m has the parity of n - m under north <->
/// south; the first derivative has the opposite one.
struct LegendreTable {
  /// [m][parity]; see synthesis_table and analysis_table for rows and columns.
  std::vector<std::array<PanelMatrix, 2>> order;

  bool empty() const { return order.empty(); }
};

/// Number of degrees n = m + parity, m + parity + 2, ... below `degrees`.
constexpr int degree_count(int degrees, int m, int parity) {
  return (degrees - m - parity + 1) / 2;
}

/// Rows: northern latitudes; columns: degrees.
LegendreTable synthesis_table(LegendreKind kind, int degrees, int latitudes);

/// Rows: degrees; columns: northern latitudes. Values times w_j 2 pi / N_phi, halved at the equator, which
/// folding the hemispheres counts twice.
LegendreTable analysis_table(int degrees, int latitudes);

}  // namespace vesiflow::vesicle
