// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The difference equations along z, put into their definition in long double.
#include "elliptic/fft/column_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace vesiflow::fluid::column_solver_test {
namespace {

using Real = long double;

// Number k of the continuation of x.
Real continued(const std::vector<Real>& x, int k, Basis ends) {
  const int n = static_cast<int>(x.size());
  if (0 <= k && k < n) return x[k];
  switch (ends) {
    case Basis::sine_points:
      return 0.0;
    case Basis::sine_cells:
      return k < 0 ? -x[0] : -x[n - 1];
    case Basis::cosine_cells:
      return k < 0 ? x[0] : x[n - 1];
    case Basis::mixed_cells:
      return k < 0 ? x[0] : -x[n - 1];
    default:
      return k < 0 ? x[n - 1] : x[0];
  }
}

// -x_{k-1} + 2 x_k - x_{k+1}
Real second_difference(const std::vector<Real>& x, int k, Basis ends) {
  return 2 * x[k] - continued(x, k - 1, ends) - continued(x, k + 1, ends);
}

class Columns : public testing::TestWithParam<Basis> {};

constexpr double coupling = 3.0;
constexpr double scale = 0.25;

TEST_P(Columns, SatisfyTheirEquationsToRoundOff) {
  // From almost singular, over decay within, and far within, the columns, to a diagonal that outweighs the coupling.
  const std::vector<double> shift{1e-3, 1e-13, 1e-8, 0.02, 0.0, 0.5, 30.0, 1e4, 1e17};
  const int columns = static_cast<int>(shift.size());
  for (const int n : {3, 4, 5, 16, 37, 200}) {
    const ColumnSolver<double> solver(n, GetParam(), columns);
    ColumnSolver<double>::Scratch scratch(solver);
    const int stride = columns + 2;
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> b(static_cast<std::size_t>(stride) * n);
    for (double& v : b) v = uniform(generator);
    std::vector<double> solution = b;
    const double mean = solver.solve(solution.data(), stride, columns, shift.data(), coupling, scale, scratch);
    for (int i = 0; i < columns; ++i) {
      std::vector<Real> x(n);
      Real largest = 0;
      for (int k = 0; k < n; ++k) {
        x[k] = solution[k * stride + i];
        largest = std::max(largest, std::abs(x[k]));
      }
      const bool singular = shift[i] == 0.0 && (GetParam() == Basis::cosine_cells || GetParam() == Basis::fourier);
      for (int k = 0; k < n; ++k) {
        const Real residual = shift[i] * x[k] + coupling * second_difference(x, k, GetParam()) -
                              scale * Real{b[k * stride + i]} + (singular ? mean : 0.0);
        // Sums of up to n terms lead from one end to the other.
        const Real bound = std::numeric_limits<double>::epsilon() * ((shift[i] + n * coupling) * largest + n * scale);
        EXPECT_LT(std::abs(residual), bound) << "n " << n << ", shift " << shift[i] << ", k " << k;
      }
    }
    EXPECT_EQ(solution[columns], b[columns]);
  }
}

TEST(ColumnSolver, IsAccurateIfAnEndIsZero) {
  const int n = 40;
  for (const Basis ends : {Basis::sine_points, Basis::sine_cells, Basis::mixed_cells}) {
    const ColumnSolver<double> solver(n, ends, 1);
    ColumnSolver<double>::Scratch scratch(solver);
    std::mt19937 generator(6);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<Real> exact(n);
    for (Real& v : exact) v = uniform(generator);
    for (const double shift : {0.0, 1e-16, 1e-10, 1e-5, 1e-3, 1e-2, 0.1}) {
      std::vector<double> x(n);
      for (int k = 0; k < n; ++k) {
        x[k] = static_cast<double>(shift * exact[k] + coupling * second_difference(exact, k, ends));
      }
      solver.solve(x.data(), 1, 1, &shift, coupling, 1.0, scratch);
      // The condition number is about (2 n / pi)^2, or four times that if one end is free; the right-hand side, which has
      // been rounded, is known no better than to epsilon. (With fused multiply-adds the error is a fifth of this.)
      const double condition = (ends == Basis::mixed_cells ? 4.0 : 1.0) * std::pow(2.0 * n / std::numbers::pi, 2);
      const double bound = condition * std::numeric_limits<double>::epsilon();
      for (int k = 0; k < n; ++k) EXPECT_NEAR(x[k], static_cast<double>(exact[k]), bound) << "shift " << shift;
    }
  }
}

std::string case_name(const testing::TestParamInfo<Basis>& info) {
  const char* names[] = {"sine_points", "sine_cells", "cosine_cells", "mixed_cells", "fourier"};
  return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Ends, Columns,
                         testing::Values(Basis::sine_points, Basis::sine_cells, Basis::cosine_cells, Basis::mixed_cells,
                                         Basis::fourier),
                         case_name);

}  // namespace
}  // namespace vesiflow::fluid::column_solver_test
