// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "harmonics/lanes.h"

namespace vesiflow::vesicle {

/// Rows per panel of a PanelMatrix.
inline constexpr int panel_rows = 8;

constexpr int padded_rows(int rows) {
  return (rows + panel_rows - 1) / panel_rows * panel_rows;
}

/// Shape and place of a dense matrix packed for multiplication with a few columns: panels of eight rows, inside a
/// panel the eight rows of one column contiguous. Rows below first_row, a multiple of four, are zero and not stored;
/// where an odd number of fours is left, the first panel has four rows. Rows beyond the last are stored as zero.
class PanelMatrix {
 public:
  PanelMatrix() = default;
  PanelMatrix(int first_row, int last_row, int columns)
      : first_row_(first_row), fours_(std::max(0, (last_row - first_row + 3) / 4)), columns_(columns) {}

  std::size_t size() const { return std::size_t(4) * fours_ * columns_; }
  void place(double* data) { data_ = data; }

  double& operator()(int row, int column) {
    const int short_rows = fours_ % 2 * 4;
    const int r = row - first_row_;
    if (r < short_rows) return data_[4 * column + r];
    const int panel = (r - short_rows) / panel_rows;
    return data_[short_rows * columns_ + (std::size_t(panel) * columns_ + column) * panel_rows +
                 (r - short_rows) % panel_rows];
  }

  /// The product with `width` columns (even): factor(k, c) is element (k, c) of the right-hand side, and
  /// use(row, c, sums) receives sums[j][i], element (row + i, c + j) of the product, in blocks of a few columns.
  /// A panel is read once for all columns.
  template <class Factor, class Use>
  void multiply(int width, const Factor& factor, const Use& use) const {
    const double* panel = data_;
    int row = first_row_;
    if (fours_ % 2 == 1) {
      multiply_panel<4>(panel, row, width, factor, use);
      panel += std::size_t(4) * columns_;
      row += 4;
    }
    const std::size_t panel_size = std::size_t(panel_rows) * columns_;
    int left = fours_ / 2;
    // Two columns of one panel are too few sums to hide the latency of adding to them.
    if (width == 2)
      for (; left >= 2; left -= 2, row += 2 * panel_rows, panel += 2 * panel_size)
        multiply_block<panel_rows, 2, 2>(panel, row, 0, factor, use);
    for (; left > 0; --left, row += panel_rows, panel += panel_size)
      multiply_panel<panel_rows>(panel, row, width, factor, use);
  }

 private:
#if defined(__AVX512F__)
  static constexpr int widest = 8;
#elif defined(__AVX__)
  static constexpr int widest = 4;
#else
  static constexpr int widest = 2;
#endif

  template <int rows, class Factor, class Use>
  void multiply_panel(const double* panel, int row, int width, const Factor& factor, const Use& use) const {
    int done = 0;
    for (; width - done >= 6; done += 6) multiply_block<rows, 6>(panel, row, done, factor, use);
    if (width - done == 4) multiply_block<rows, 4>(panel, row, done, factor, use);
    if (width - done == 2) multiply_block<rows, 2>(panel, row, done, factor, use);
  }

  /// The sums of 6 columns by 8 rows stay in registers with AVX and up, for which all inner loops must be unrolled.
  /// Eigen's general product reaches less than half of this kernel's speed at such widths.
  template <int rows, int width, int panels = 1, class Factor, class Use>
  void multiply_block(const double* panel, int row, int column, const Factor& factor, const Use& use) const {
    constexpr int lanes = std::min(rows, widest);
    constexpr int vectors = rows / lanes * panels;
    using Vector = VectorOf<lanes>;
    Vector sum[width][vectors];
#pragma GCC unroll 8
    for (int c = 0; c < width; ++c)
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) sum[c][v] = Vector{};
    const std::ptrdiff_t next_panel = std::ptrdiff_t(rows) * columns_;
    for (int k = 0; k < columns_; ++k, panel += rows) {
      Vector left[vectors];
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v)
        left[v] = load<Vector>(panel + v * lanes / rows * next_panel + v * lanes % rows);
#pragma GCC unroll 8
      for (int c = 0; c < width; ++c) {
        const double right = factor(k, column + c);
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v) sum[c][v] += left[v] * right;
      }
    }
    use(row, column, sum);
  }

  double* data_ = nullptr;
  int first_row_ = 0;
  int fours_ = 0;
  int columns_ = 0;
};

/// Sums of PanelMatrix::multiply to the columns of an array.
template <class Sums>
void store_columns(const Sums& sums, double* to, std::ptrdiff_t stride) {
#pragma GCC unroll 8
  for (int c = 0; c < int(std::extent_v<Sums, 0>); ++c)
#pragma GCC unroll 8
    for (int v = 0; v < int(std::extent_v<Sums, 1>); ++v) {
      const auto lanes = sums[c][v];
      store(to + c * stride + v * std::ptrdiff_t(sizeof lanes / sizeof(double)), lanes);
    }
}

/// The first `rows` of the sums to, or added to, the rows of an array; columns by pairs, as complex numbers.
template <bool add, class Sums>
void store_rows(const Sums& sums, int rows, double* to, std::ptrdiff_t stride) {
  constexpr int lanes = int(sizeof(sums[0][0]) / (sizeof(double)));
#pragma GCC unroll 16
  for (int r = 0; r < lanes * int(std::extent_v<Sums, 1>); ++r) {
    if (r == rows) return;
#pragma GCC unroll 8
    for (int c = 0; c < int(std::extent_v<Sums, 0>); c += 2) {
      double* const number = to + r * stride + c;
      VectorOf<2> sum{sums[c][r / lanes][r % lanes], sums[c + 1][r / lanes][r % lanes]};
      if constexpr (add) sum += load<VectorOf<2>>(number);
      store(number, sum);
    }
  }
}

}  // namespace vesiflow::vesicle
