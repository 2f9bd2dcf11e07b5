// Complex Fourier transforms of the lines of a block.
#pragma once

#include <cstddef>
#include <vector>

#include "fftw_plan.h"

namespace vesiflow::fluid {

enum class Direction { forward, backward };

// Z_k = sum_j z_j exp(-+ 2 pi i j k / n) for the lanes / 2 complex lines of a block (lanes.h), by FFTW.
//
// Long lines whose length is a multiple of three are first split into three by a step of our own: what FFTW estimates
// to be fast for them takes twice as long (192 and 384 points; bench/elliptic).
class BlockFft {
 public:
  BlockFft(int n, Direction direction);

  // block is spoilt. Both have n rows, and are from allocate_aligned or a whole number of rows further.
  void execute(double* block, double* result) const;
  // Where the row of Z_k begins in the result.
  std::ptrdiff_t row(int k) const { return rows_[k]; }

 private:
  void split(double* block) const;

  int third_;  // of n, or n itself if it is not split
  std::vector<std::ptrdiff_t> rows_;
  std::vector<double> cosine_, sine_;  // of 2 pi j / n and 4 pi j / n, alternating
  double root_ = 0.0;                  // sin(2 pi / 3), with the sign of the transform
  FftwPlan plan_;
};

}  // namespace vesiflow::fluid
