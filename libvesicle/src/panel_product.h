#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "lanes.h"

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

  int first_row() const { return first_row_; }
  int columns() const { return columns_; }
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
  /// store(row, c, sums) receives sums[j][i], element (row + i, c + j) of the product, in blocks of a few columns.
  /// A panel is read once for all columns.
  template <class Factor, class Store>
  void multiply(int width, const Factor& factor, const Store& store) const {
    const double* panel = data_;
    int row = first_row_;
    if (fours_ % 2 == 1) {
      multiply_panel<4>(panel, row, width, factor, store);
      panel += std::size_t(4) * columns_;
      row += 4;
    }
    for (int p = 0; p < fours_ / 2; ++p, row += panel_rows, panel += std::size_t(panel_rows) * columns_)
      multiply_panel<panel_rows>(panel, row, width, factor, store);
  }

 private:
#if defined(__AVX512F__)
  static constexpr int widest = 8;
#elif defined(__AVX__)
  static constexpr int widest = 4;
#else
  static constexpr int widest = 2;
#endif

  template <int rows, class Factor, class Store>
  void multiply_panel(const double* panel, int row, int width, const Factor& factor, const Store& store) const {
    int done = 0;
    for (; width - done >= 6; done += 6) multiply_block<rows, 6>(panel, row, done, factor, store);
    if (width - done == 4) multiply_block<rows, 4>(panel, row, done, factor, store);
    if (width - done == 2) multiply_block<rows, 2>(panel, row, done, factor, store);
  }

  /// The sums of 6 columns by 8 rows stay in registers with AVX and up, for which all inner loops must be unrolled.
  /// Eigen's general product reaches less than half of this kernel's speed at such widths.
  template <int rows, int width, class Factor, class Store>
  void multiply_block(const double* panel, int row, int column, const Factor& factor, const Store& store) const {
    constexpr int lanes = std::min(rows, widest);
    constexpr int vectors = rows / lanes;
    using Vector = VectorOf<lanes>;
    Vector sum[width][vectors];
#pragma GCC unroll 8
    for (int c = 0; c < width; ++c)
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) sum[c][v] = Vector{};
    for (int k = 0; k < columns_; ++k, panel += rows) {
      Vector left[vectors];
      std::memcpy(left, panel, sizeof left);
#pragma GCC unroll 8
      for (int c = 0; c < width; ++c) {
        const double right = factor(k, column + c);
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v) sum[c][v] += left[v] * right;
      }
    }
    store(row, column, sum);
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
  for (std::size_t c = 0; c < std::extent_v<Sums>; ++c) std::memcpy(to + c * stride, &sums[c], sizeof(sums[c]));
}

/// The first `rows` of the sums to, or added to, the rows of an array.
template <class Sums>
void store_rows(const Sums& sums, int rows, bool add, double* to, std::ptrdiff_t stride) {
  constexpr int width = std::extent_v<Sums>, column_bytes = sizeof(std::remove_extent_t<Sums>);
  constexpr int height = column_bytes / int(sizeof(double));
  double columns[width][height];
  store_columns(sums, columns[0], height);
  for (int r = 0; r < std::min(rows, height); ++r, to += stride)
#pragma GCC unroll 8
    for (int c = 0; c < width; ++c) to[c] = (add ? to[c] : 0) + columns[c][r];
}

}  // namespace vesiflow::vesicle
