// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Sine, cosine and Fourier transforms of several real lines at once, by complex FFTs of pairs of lines.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "elliptic/fft/block_fft.h"
#include "elliptic/fft/single_fft.h"

namespace vesiflow::fluid {

// The forward transform's basis along a line.
enum class Basis {
  sine_points,   // DST-I: zero on points one step outside
  sine_cells,    // DST-II: odd about walls half a step outside
  cosine_cells,  // DCT-II: even about walls half a step outside
  mixed_cells,   // DCT-IV: even about the lower end and odd about the upper, half a step outside
  fourier        // of period n, as real numbers
};

// Where a number stands in a block: in the row that begins at offset, with a sign.
template <class Scalar>
struct Place {
  std::ptrdiff_t offset = 0;
  Scalar sign = 1;
};

// Of n numbers x_j, j = 0 .. n-1, with the definitions (and factors) of FFTW:
//
//   sine_points   forward = backward  y_k = 2 sum_j x_j sin(pi (j+1) (k+1) / (n+1))
//   sine_cells    forward             y_k = 2 sum_j x_j sin(pi (j+1/2) (k+1) / n)
//                 backward            y_k = (-1)^k x_{n-1} + 2 sum_{j<n-1} x_j sin(pi (j+1) (k+1/2) / n)
//   cosine_cells  forward             y_k = 2 sum_j x_j cos(pi (j+1/2) k / n)
//                 backward            y_k = x_0 + 2 sum_{j>0} x_j cos(pi j (k+1/2) / n)
//   mixed_cells   forward = backward  y_k = 2 sum_j x_j cos(pi (j+1/2) (k+1/2) / n)
//   fourier         forward             y_k = sum_j x_j cos(2 pi j k / n) for k <= n/2,
//                                       y_k = sum_j x_j sin(2 pi j k / n) above (half-complex order)
//                   backward            y_k = sum_j (1 or 2) x_j (cos or sin)(2 pi j k / n), 1 for j = 0 and n/2
//
// The numbers of lanes<Scalar> lines (lanes.h) stand side by side in a block: number j of line l at row j, column l.
// Lines 2l and 2l+1 are the real and imaginary parts of one complex line.
template <class Scalar>
class LineTransform {
 public:
  LineTransform(int length, Basis basis, Direction direction);
  ~LineTransform();
  LineTransform(const LineTransform&) = delete;
  LineTransform& operator=(const LineTransform&) = delete;

  // Number i of line l belongs at input()[i].offset + l in the block, times the sign there; its transform is then
  // found at output()[i].offset + l in the result, to be multiplied by that sign.
  const Place<Scalar>* input() const { return input_.data(); }
  const Place<Scalar>* output() const { return output_.data(); }

  // Transforms a block, which is spoilt. block and result have block_size() numbers, from allocate_aligned or a
  // whole number of rows further. Any number of threads may do this at once, each with its own blocks. Nothing is
  // allocated, unless n (n + 1 for sine_points) has a prime factor above 31: for these FFTW itself does, in double precision.
  void execute(Scalar* block, Scalar* result) const;

  std::size_t block_size() const { return block_size(basis_, length_); }
  static std::size_t block_size(Basis basis, int length);

  // forward then backward multiplies by this.
  static double pair_factor(Basis basis, int length);

 private:
  using Fft = std::conditional_t<std::is_same_v<Scalar, double>, BlockFft, SingleFft>;

  void plan_cells();
  void plan_mixed_cells();
  void plan_points();
  void transform_points(Scalar* block, Scalar* result) const;
  void prepare_cells(Scalar* block) const;
  void finish_cells(Scalar* block) const;
  void prepare_mixed_cells(Scalar* block) const;
  void finish_mixed_cells(Scalar* block) const;
  void prepare_waves(Scalar* block) const;
  void finish_waves(Scalar* block) const;
  void fold_points(Scalar* block) const;
  void sum_points(const Scalar* block, Scalar* result) const;
  void extend_points(Scalar* block) const;

  int length_;
  int intervals_;  // length, or one more for sine_points
  Basis basis_;
  Direction direction_;
  std::vector<Scalar> cosine_, sine_;
  std::vector<Scalar> wave_cosine_, wave_sine_;  // of pi j / n, for mixed_cells
  std::vector<Place<Scalar>> input_, output_;
  std::unique_ptr<Fft> fft_;                               // of cells, waves, or points extended to a period
  std::unique_ptr<LineTransform> odd_modes_, even_modes_;  // of points, if their number of intervals is even
};

}  // namespace vesiflow::fluid
