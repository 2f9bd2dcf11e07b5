#pragma once

#include <cstddef>
#include <vector>

namespace vesiflow::vesicle {

/// Rows per panel of a PanelMatrix.
inline constexpr int panel_rows = 8;

constexpr int padded_rows(int rows) {
  return (rows + panel_rows - 1) / panel_rows * panel_rows;
}

/// A dense matrix packed for multiplication with a few columns: panels of eight rows (zero-padded), inside a
/// panel the eight rows of one column contiguous.
class PanelMatrix {
 public:
  PanelMatrix() = default;
  PanelMatrix(int rows, int columns)
      : panels_(padded_rows(rows) / panel_rows),
        columns_(columns),
        data_(std::size_t(panels_) * panel_rows * columns) {}

  double& operator()(int row, int column) {
    return data_[(std::size_t(row / panel_rows) * columns_ + column) * panel_rows + row % panel_rows];
  }

  /// result = this * factor, for `width` columns (even). factor: (columns, >= width) row-major with the given
  /// row stride. result: column-major, (padded rows, width), column stride as given.
  void multiply(const double* factor, int factor_stride, int width, double* result, int result_stride) const {
    int done = 0;
    for (; width - done >= 6; done += 6)
      multiply_block<6>(factor + done, factor_stride, result + std::ptrdiff_t(done) * result_stride, result_stride);
    for (; width - done >= 2; done += 2)
      multiply_block<2>(factor + done, factor_stride, result + std::ptrdiff_t(done) * result_stride, result_stride);
  }

 private:
#if defined(__AVX512F__)
  static constexpr int lanes = 8;
#elif defined(__AVX__)
  static constexpr int lanes = 4;
#else
  static constexpr int lanes = 2;
#endif
  using Lanes __attribute__((vector_size(lanes * sizeof(double)), aligned(alignof(double)), may_alias)) = double;
  static constexpr int vectors = panel_rows / lanes;

  /// The accumulators of 6 columns by one panel stay in registers with AVX and up, for which all inner loops
  /// must be unrolled. Eigen's general product reaches less than half of this kernel's speed at such widths.
  template <int Width>
  void multiply_block(const double* factor, int factor_stride, double* result, int result_stride) const {
    const double* panel = data_.data();
    for (int p = 0; p < panels_; ++p, result += panel_rows) {
      Lanes sum[Width][vectors];
#pragma GCC unroll 8
      for (int c = 0; c < Width; ++c)
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v) sum[c][v] = Lanes{};
      const double* row = factor;
      for (int k = 0; k < columns_; ++k, panel += panel_rows, row += factor_stride) {
        const Lanes* left = reinterpret_cast<const Lanes*>(panel);
#pragma GCC unroll 8
        for (int c = 0; c < Width; ++c)
#pragma GCC unroll 8
          for (int v = 0; v < vectors; ++v) sum[c][v] += left[v] * row[c];
      }
#pragma GCC unroll 8
      for (int c = 0; c < Width; ++c)
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v)
          reinterpret_cast<Lanes*>(result + std::ptrdiff_t(c) * result_stride)[v] = sum[c][v];
    }
  }

  int panels_ = 0;
  int columns_ = 0;
  std::vector<double> data_;
};

}  // namespace vesiflow::vesicle
