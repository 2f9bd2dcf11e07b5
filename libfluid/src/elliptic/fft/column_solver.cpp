// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// With r + 1/r = 2 + shift/s, 0 < r < 1, the operator on an unbounded line is s/r (1 - r S) (1 - r S^-1), where S moves
// numbers one place up. Hence two sweeps without a division,
//   y_k = c b_k + r y_{k-1},   x_k = y_k + r x_{k+1},   c = scale r / s,
// which are stable as r < 1, and have for coefficients the same few rows in every plane. b is continued as x is, with
// period P (n, or 2n, or 2n + 2 between zeros), so that
//   y_{-1} = c sum_m r^m b_{-1-m} = c (sum of m < P) / (1 - r^P),
// or with the sign changed after P = 2n if the lower end is even and the upper odd, and 1 + r^P for 1 - r^P,
// and x_n follows from x_{n-1} by the continuation, or in the periodic case from the like sum over y. Sums end where r^m
// is below round-off. That is after a few terms for most columns.
//
// Where r is almost 1 between zeros the sum for y_{-1} cancels, and at shift = 0 there may be no solution. Such columns,
// hardly ever more than one, pass through the sweeps with r = 0 and are solved by themselves.
#include "elliptic/fft/column_solver.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace vesiflow::fluid {
namespace {

// theta with r = exp(-theta), for ratio = shift / s.
double decay_rate(double ratio) {
  return std::log1p(0.5 * ratio + std::sqrt(ratio + 0.25 * ratio * ratio));
}

template <class Scalar>
void prefetch(const Scalar* row, int columns) {
  for (int i = 0; i < columns; i += static_cast<int>(64 / sizeof(Scalar))) __builtin_prefetch(row + i, 1, 2);
}

// row[i] = b[i] + r[i] row[i] for the rows of b in the order they are given by first and step: the sum of r^m b, m
// counted from the last.
template <class Scalar>
void accumulate(const Scalar* b, std::ptrdiff_t step, int rows, int columns, const Scalar* r, Scalar* sum) {
  for (int m = 0; m < rows; ++m, b += step) {
    if (m + 4 < rows) prefetch(b + 4 * step, columns);
    for (int i = 0; i < columns; ++i) sum[i] = b[i] + r[i] * sum[i];
  }
}

}  // namespace

// Rows of one number per column: r, c, the row below or above the sweep, and another sum.
template <class Scalar>
struct ColumnSolver<Scalar>::Rows {
  Rows(const Scratch& scratch, int columns_, std::ptrdiff_t row_stride)
      : columns(columns_),
        decay(scratch.values.get()),
        factor(decay + row_stride),
        neighbour(factor + row_stride),
        far(neighbour + row_stride),
        slab(far + row_stride) {}
  int columns;
  Scalar *decay, *factor, *neighbour, *far, *slab;
};

template <class Scalar>
ColumnSolver<Scalar>::ColumnSolver(int n, Basis ends, int columns)
    : n_(n), ends_(ends), row_stride_(padded<Scalar>(columns)), half_period_(ends == Basis::sine_points ? n + 1 : n) {}

template <class Scalar>
ColumnSolver<Scalar>::Scratch::Scratch(const ColumnSolver& solver)
    : values(allocate_aligned<Scalar>(static_cast<std::size_t>((solver.n_ + 4) * solver.row_stride_))),
      column(solver.n_),
      factors(solver.n_) {}

template <class Scalar>
std::size_t ColumnSolver<Scalar>::scratch_size(int n, int columns) {
  return static_cast<std::size_t>((n + 4) * padded<Scalar>(columns)) + 2 * n;
}

template <class Scalar>
bool ColumnSolver<Scalar>::is_direct(double shift, double s) const {
  if (ends_ == Basis::mixed_cells) return false;
  const bool zeros = ends_ == Basis::sine_points || ends_ == Basis::sine_cells;
  return shift == 0.0 || (zeros && half_period_ * decay_rate(shift / s) < 1.0);
}

template <class Scalar>
double ColumnSolver<Scalar>::solve(Scalar* x, std::ptrdiff_t stride, int columns, const double* shift, double s,
                                   double scale, Scratch& scratch) const {
  const Rows rows(scratch, columns, row_stride_);
  const int reach = set_up(shift, s, scale, rows);
  const Scalar* r = rows.decay;
  const Scalar* c = rows.factor;
  start_upwards(x, stride, reach, shift, s, rows);
  const Scalar* below = rows.neighbour;
  for (int k = 0; k < n_; ++k) {
    const Scalar* b = x + k * stride;
    Scalar* y = rows.slab + k * row_stride_;
    if (k + 4 < n_) prefetch(b + 4 * stride, columns);
    for (int i = 0; i < columns; ++i) y[i] = c[i] * b[i] + r[i] * below[i];
    below = y;
  }
  start_downwards(reach, shift, s, rows);
  const Scalar* above = rows.neighbour;
  for (int k = n_ - 1; k >= 0; --k) {
    const Scalar* y = rows.slab + k * row_stride_;
    Scalar* out = x + k * stride;
    for (int i = 0; i < columns; ++i) out[i] = y[i] + r[i] * above[i];
    above = out;
  }
  double removed_mean = 0.0;
  if (reach > half_period_) {
    for (int i = 0; i < columns; ++i) {
      if (is_direct(shift[i], s)) removed_mean += solve_directly(x + i, stride, shift[i], s, scratch);
    }
  }
  return removed_mean;
}

// r and c of all columns. Returns the number of terms after which r^m is below round-off for all, or one more than the
// half period.
template <class Scalar>
int ColumnSolver<Scalar>::set_up(const double* shift, double s, double scale, const Rows& rows) const {
  const double inverse = 1.0 / s;
  const double slowest = decay_rate(*std::min_element(shift, shift + rows.columns) * inverse);
  for (int i = 0; i < rows.columns; ++i) {
    const double ratio = shift[i] * inverse;
    const double r = 1.0 / (1.0 + 0.5 * ratio + std::sqrt(ratio + 0.25 * ratio * ratio));
    rows.decay[i] = static_cast<Scalar>(r);
    rows.factor[i] = static_cast<Scalar>(scale * inverse * r);
  }
  constexpr double negligible = std::is_same_v<Scalar, double> ? 42.0 : 21.0;  // exp(-42) = 6e-19, exp(-21) = 8e-10
  if (half_period_ * slowest < negligible) {
    for (int i = 0; i < rows.columns; ++i) {
      if (is_direct(shift[i], s)) {
        rows.decay[i] = 0;
        rows.factor[i] = static_cast<Scalar>(scale);
      }
    }
    return half_period_ + 1;
  }
  return static_cast<int>(std::ceil(negligible / slowest));
}

// y_{-1} into the row of neighbours.
template <class Scalar>
void ColumnSolver<Scalar>::start_upwards(const Scalar* b, std::ptrdiff_t stride, int reach, const double* shift,
                                         double s, const Rows& rows) const {
  const int columns = rows.columns;
  const int terms = std::min(reach, n_);
  const Scalar* r = rows.decay;
  const Scalar* c = rows.factor;
  Scalar* start = rows.neighbour;
  std::fill_n(start, columns, Scalar(0));
  std::fill_n(rows.far, columns, Scalar(0));
  const bool far = reach > half_period_;
  if (ends_ == Basis::fourier) {
    accumulate(b + (n_ - terms) * stride, stride, terms, columns, r, start);
  } else {
    accumulate(b + (terms - 1) * stride, -stride, terms, columns, r, start);
    if (far) accumulate(b, stride, n_, columns, r, rows.far);
  }
  const double sign = ends_ == Basis::sine_points || ends_ == Basis::sine_cells ? -1.0 : 1.0;
  for (int i = 0; i < columns; ++i) {
    const double first = ends_ == Basis::sine_points ? c[i] * r[i] : c[i];
    double sum = sign * start[i];
    if (far && r[i] > 0.0) {
      const double exponent = -half_period_ * decay_rate(shift[i] / s);
      if (ends_ == Basis::fourier) {
        sum /= -std::expm1(exponent);
      } else if (ends_ == Basis::mixed_cells) {
        sum = (sum - std::exp(exponent) * rows.far[i]) / (1.0 + std::exp(2.0 * exponent));
      } else {
        sum = (sum + std::exp(exponent) * rows.far[i]) / -std::expm1(2.0 * exponent);
      }
    }
    start[i] = static_cast<Scalar>(first * sum);
  }
}

// x_n into the row of neighbours.
template <class Scalar>
void ColumnSolver<Scalar>::start_downwards(int reach, const double* shift, double s, const Rows& rows) const {
  const int columns = rows.columns;
  const Scalar* r = rows.decay;
  const Scalar* last = rows.slab + (n_ - 1) * row_stride_;
  Scalar* start = rows.neighbour;
  switch (ends_) {
    case Basis::sine_points:
      std::fill_n(start, columns, Scalar(0));
      break;
    case Basis::sine_cells:
    case Basis::mixed_cells:  // x_n = -x_{n-1}
      for (int i = 0; i < columns; ++i) start[i] = -last[i] / (Scalar(1) + r[i]);
      break;
    case Basis::cosine_cells:  // x_n = x_{n-1}
      for (int i = 0; i < columns; ++i) {
        const double ratio = shift[i] / s;
        const double grow = 0.5 * ratio + std::sqrt(ratio + 0.25 * ratio * ratio);  // 1/r - 1, also where r rounds to 1
        start[i] = r[i] > 0 ? static_cast<Scalar>(last[i] / (grow * r[i])) : Scalar(0);
      }
      break;
    case Basis::fourier: {
      const int terms = std::min(reach, n_);
      std::fill_n(start, columns, Scalar(0));
      accumulate(rows.slab + (terms - 1) * row_stride_, -row_stride_, terms, columns, r, start);
      if (reach <= half_period_) break;
      for (int i = 0; i < columns; ++i) {
        if (r[i] > 0) start[i] = static_cast<Scalar>(start[i] / -std::expm1(-half_period_ * decay_rate(shift[i] / s)));
      }
    }
  }
}

template <class Scalar>
double ColumnSolver<Scalar>::solve_directly(Scalar* x, std::ptrdiff_t stride, double shift, double s,
                                            Scratch& scratch) const {
  double* column = scratch.column.data();
  for (int k = 0; k < n_; ++k) column[k] = x[k * stride];
  double mean = 0.0;
  if (ends_ == Basis::sine_points || ends_ == Basis::sine_cells) {
    // Elimination; the equation at an end lacks the neighbour that is zero, or minus x itself.
    const double end = ends_ == Basis::sine_points ? 2.0 : 3.0;
    double* g = scratch.factors.data();
    for (int k = 0; k < n_; ++k) {
      const double diagonal = shift + s * (k == 0 || k == n_ - 1 ? end : 2.0);
      const double pivot = k == 0 ? diagonal : diagonal - s * g[k - 1];
      g[k] = s / pivot;
      column[k] = (column[k] + (k == 0 ? 0.0 : s * column[k - 1])) / pivot;
    }
    for (int k = n_ - 2; k >= 0; --k) column[k] += g[k] * column[k + 1];
  } else {
    // shift = 0. s (x_{k+1} - x_k) is a flux at the lower end minus the sum of b - mean up to k; that flux is zero at a
    // wall, and in the periodic case such that x_n = x_0.
    for (int k = 0; k < n_; ++k) mean += column[k];
    mean /= n_;
    double sum = 0.0;
    double flux = 0.0;
    for (int k = 0; k < n_; ++k) {
      sum += column[k] - mean;
      flux += sum;
    }
    flux = ends_ == Basis::fourier ? flux / n_ : 0.0;
    double value = 0.0;
    double total = 0.0;
    for (int k = 0; k < n_; ++k) {
      flux -= column[k] - mean;
      column[k] = value;
      total += value;
      value += flux / s;
    }
    for (int k = 0; k < n_; ++k) column[k] -= total / n_;
  }
  for (int k = 0; k < n_; ++k) x[k * stride] = static_cast<Scalar>(column[k]);
  return mean;
}

template class ColumnSolver<double>;
template class ColumnSolver<float>;

}  // namespace vesiflow::fluid
