// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "operators/block_algebra.h"

namespace vesiflow::fluid {

template <class SumOfPlane>
double PlaneSums::total(const std::array<int, 3>& extent, SumOfPlane&& sum_of_plane) {
  for_each_plane(extent, [&](int k) { sums_[k] = sum_of_plane(k); });
  double sum = 0.0;
  for (int k = 0; k < extent[2]; ++k) sum += sums_[k];
  return sum;
}

double PlaneSums::dot(ConstBlocks a, ConstBlocks b) {
  double sum_of_blocks = 0.0;
  for (int block = 0; block < a.count(); ++block) {
    const auto n = a[block].extent;
    sum_of_blocks += total(n, [&](int k) {
      double sum = 0.0;
      for (int j = 0; j < n[1]; ++j) {
        const double* x = a[block].row(j, k);
        const double* y = b[block].row(j, k);
#pragma omp simd reduction(+ : sum)
        for (int i = 0; i < n[0]; ++i) sum += x[i] * y[i];
      }
      return sum;
    });
  }
  return sum_of_blocks;
}

std::array<double, 3> PlaneSums::remove_means(Blocks x) {
  std::array<double, 3> means{};
  for (int block = 0; block < x.count(); ++block) {
    const View& view = x[block];
    const auto n = view.extent;
    means[block] = total(n, [&](int k) {
      double sum = 0.0;
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) sum += view(i, j, k);
      }
      return sum;
    });
    means[block] /= static_cast<double>(n[0]) * n[1] * n[2];
    for_each_plane(n, [&](int k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) view(i, j, k) -= means[block];
      }
    });
  }
  return means;
}

}  // namespace vesiflow::fluid
