// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The vector algebra of iterative methods on arrays of unknowns, parallel over planes. Sums are taken plane by plane
// and then in order: the same bits for every number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "fluid/view.h"
#include "grid/planes.h"

namespace vesiflow::fluid {

// visit(row of y, row of x, length) for all rows.
template <class Visit>
void for_each_row(ConstBlocks x, Blocks y, Visit&& visit) {
  for (int block = 0; block < y.count(); ++block) {
    const View& to = y[block];
    for_each_plane(to.extent, [&](int k) {
      for (int j = 0; j < to.extent[1]; ++j) visit(to.row(j, k), x[block].row(j, k), to.extent[0]);
    });
  }
}

inline void copy(ConstBlocks x, Blocks y) {
  for_each_row(x, y, [](double* to, const double* from, int n) { std::copy_n(from, n, to); });
}

inline void set_zero(Blocks y) {
  for_each_row(y, y, [](double* to, const double*, int n) { std::fill_n(to, n, 0.0); });
}

// y *= factor.
inline void scale(double factor, Blocks y) {
  for_each_row(y, y, [factor](double* to, const double*, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i) to[i] *= factor;
  });
}

// y += factor x.
inline void add(double factor, ConstBlocks x, Blocks y) {
  for_each_row(x, y, [factor](double* to, const double* from, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i) to[i] += factor * from[i];
  });
}

// y = x + factor y.
inline void scale_and_add(double factor, ConstBlocks x, Blocks y) {
  for_each_row(x, y, [factor](double* to, const double* from, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i) to[i] = from[i] + factor * to[i];
  });
}

// y += constant.
inline void add_constant(double constant, View y) {
  for_each_row(y, y, [constant](double* to, const double*, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i) to[i] += constant;
  });
}

// Sums over arrays of at most that many planes.
class PlaneSums {
 public:
  explicit PlaneSums(int planes = 0) : sums_(static_cast<std::size_t>(planes)) {}
  double dot(ConstBlocks a, ConstBlocks b);
  // Subtracts from each block its mean, and returns these.
  std::array<double, 3> remove_means(Blocks x);

 private:
  template <class SumOfPlane>
  double total(const std::array<int, 3>& extent, SumOfPlane&& sum_of_plane);

  std::vector<double> sums_;
};

}  // namespace vesiflow::fluid
