// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Complex Fourier transforms of the lines of a block.
#pragma once

#include <cstddef>
#include <vector>

#include "elliptic/fft/fftw_plan.h"

namespace vesiflow::fluid {

enum class Direction { forward, backward };

// Z_k = sum_j z_j exp(-+ 2 pi i j k / n) for the lanes<double> / 2 complex lines of a block (lanes.h), by FFTW.
//
// Long lines are first split by a step of our own, into three because what FFTW estimates to be fast for such lengths
// takes twice as long (192 and 384 points), or into two whose transform fits the first-level cache.
class BlockFft {
 public:
  BlockFft(int n, Direction direction);

  // block is spoilt. Both have n rows, and are from allocate_aligned or a whole number of rows further.
  void execute(double* block, double* result) const;
  // Where the row of Z_k begins in the result.
  std::ptrdiff_t row(int k) const { return rows_[k]; }

 private:
  void split_in_two(double* block) const;
  void split_in_three(double* block) const;

  int parts_;
  int length_;   // of a part
  double sign_;  // of the exponent
  std::vector<std::ptrdiff_t> rows_;
  std::vector<double> cosine_, sine_;  // of 2 pi j s / n, s = 1 .. parts - 1 fastest
  FftwPlan plan_;
};

}  // namespace vesiflow::fluid
