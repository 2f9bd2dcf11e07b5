// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The difference equations along z that remain after the transforms in x and y.
#pragma once

#include <cstddef>
#include <vector>

#include "elliptic/fft/line_transform.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {

// Solves -s x_{k-1} + (shift + 2 s) x_k - s x_{k+1} = scale b_k, k = 0 .. n-1, for several columns x that stand side by
// side and have their own shift >= 0. What is outside 0 .. n-1 follows from the basis of the ends: x is zero one step
// outside (sine_points), continues oddly or evenly about half a step outside (sine_cells, cosine_cells; mixed_cells:
// evenly below 0 and oddly above n-1), or has the period n (fourier).
template <class Scalar>
class ColumnSolver {
 public:
  // For up to `columns` columns at a time.
  ColumnSolver(int n, Basis ends, int columns);

  struct Scratch {
    explicit Scratch(const ColumnSolver& solver);
    AlignedArrayOf<Scalar> values;
    std::vector<double> column, factors;  // of a column that is solved by itself
  };
  static std::size_t scratch_size(int n, int columns);

  // Number k of column i is at x[i + k * stride]: b, and then the solution. If the shift of a column (there must
  // be no more than one) is zero and neither end holds x, its mean is removed from b and from x, and that of
  // scale b is returned (else zero).
  double solve(Scalar* x, std::ptrdiff_t stride, int columns, const double* shift, double s, double scale,
               Scratch& scratch) const;

 private:
  struct Rows;
  int set_up(const double* shift, double s, double scale, const Rows& rows) const;
  void start_upwards(const Scalar* b, std::ptrdiff_t stride, int reach, const double* shift, double s,
                     const Rows& rows) const;
  void start_downwards(int reach, const double* shift, double s, const Rows& rows) const;
  double solve_directly(Scalar* x, std::ptrdiff_t stride, double shift, double s, Scratch& scratch) const;
  bool is_direct(double shift, double s) const;

  int n_;
  Basis ends_;
  std::ptrdiff_t row_stride_;
  int half_period_;  // of the continuation (the whole one if periodic)
};

}  // namespace vesiflow::fluid
