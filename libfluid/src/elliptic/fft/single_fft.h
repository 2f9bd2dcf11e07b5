// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Complex Fourier transforms of the lines of a block in single precision.
#pragma once

#include <cstddef>
#include <vector>

#include "elliptic/fft/block_fft.h"

namespace vesiflow::fluid {

// What BlockFft does, for the lanes<float> / 2 complex lines of a block of float, by our own sums: FFTW's plans for
// such blocks take hardly less time per number in single than in double precision, 0.8 to 1.0 of it; these 0.2 to 0.7
// (docs/adr/0011-single-precision-in-the-velocity-solve.md).
class SingleFft {
 public:
  SingleFft(int n, Direction direction);

  // block is spoilt. Both have n rows, and are from allocate_aligned or a whole number of rows further.
  void execute(float* block, float* result) const;
  // Where the row of Z_k begins in the result.
  std::ptrdiff_t row(int k) const { return rows_[k]; }

 private:
  // Sums over `radix` rows that stand parts * stride rows apart.
  struct Pass {
    int radix, parts, stride;
    std::size_t factors, roots;  // where they begin
  };
  template <int radix>
  void run(const Pass& pass, const float* in, float* out) const;
  void run_any(const Pass& pass, const float* in, float* out) const;  // which differ
  void run(const Pass& pass, const float* in, float* out) const;

  float sign_;  // of the exponent
  std::vector<std::ptrdiff_t> rows_;
  std::vector<Pass> passes_;
  // What passes multiply their sums by, and the roots exp(2 pi i j / radix) of those with a radix above 5; sines with the
  // sign of the exponent.
  std::vector<float> cosine_, sine_;
};

}  // namespace vesiflow::fluid
