// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "jet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// In units of the rounding of long double, about 1e-19.
constexpr double tolerance = 1e-17;

long double factorial(int n) {
  return n < 2 ? 1 : n * factorial(n - 1);
}

TEST(Jet, ExponentialOfALinearFunction) {
  const long double a = 0.7L, b = -1.3L, c = 0.4L;
  const Jet<4> f = exp(Jet<4>(c) + a * Jet<4>::u() + b * Jet<4>::v());
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      EXPECT_NEAR(double(f(i, j)),
                  double(std::exp(c) * std::pow(a, i) * std::pow(b, j) / (factorial(i) * factorial(j))), tolerance);
}

// 1 / (2 - u - 3 v) = sum_k (u + 3 v)^k / 2^{k+1}.
TEST(Jet, Quotient) {
  const Jet<4> f = Jet<4>(1) / (Jet<4>(2) - Jet<4>::u() - 3 * Jet<4>::v());
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      EXPECT_NEAR(
          double(f(i, j)),
          double(factorial(i + j) / (factorial(i) * factorial(j)) * std::pow(3.0L, j) / std::pow(2.0L, i + j + 1)),
          tolerance);
}

// sqrt(1 + u) = 1 + u/2 - u^2/8 + u^3/16 - 5 u^4/128.
TEST(Jet, SquareRoot) {
  const Jet<4> f = sqrt(Jet<4>(1) + Jet<4>::u());
  const double expected[] = {1, 0.5, -0.125, 0.0625, -5.0 / 128};
  for (int i = 0; i <= 4; ++i) EXPECT_NEAR(double(f(i, 0)), expected[i], tolerance);
  for (int i = 0; i <= 3; ++i) EXPECT_EQ(f(i, 1), 0);
}

// (sqrt f)^2 = f, f (1/f) = 1 and exp(f) exp(-f) = 1 with all mixed terms.
TEST(Jet, Identities) {
  const Jet<4> u = Jet<4>::u(), v = Jet<4>::v();
  const Jet<4> f = Jet<4>(1.9L) + u * v - 0.3L * (u * u * v) + 0.8L * v + 1.1L * u - v * v * v * v;
  const Jet<4> root = sqrt(f), square = root * root, one = f * (Jet<4>(1) / f), unit = exp(f) * exp(-f);
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j) {
      EXPECT_NEAR(double(square(i, j) - f(i, j)), 0, tolerance);
      EXPECT_NEAR(double(one(i, j)), i + j == 0 ? 1 : 0, tolerance);
      EXPECT_NEAR(double(unit(i, j)), i + j == 0 ? 1 : 0, tolerance);
    }
}

// d/du and d/dv of u^2 v + 5 v^3 + exp(u) v at the origin: of the product rule, the chain rule and the order of the result.
TEST(Jet, Derivatives) {
  const Jet<4> u = Jet<4>::u(), v = Jet<4>::v();
  const Jet<4> f = u * u * v + 5 * (v * v * v) + exp(u) * v;
  const Jet<3> fu = f.du(), fv = f.dv();
  EXPECT_EQ(fu(1, 1), 3);  // 2 u v + exp(u) v
  EXPECT_EQ(fu(0, 1), 1);
  EXPECT_EQ(fu(2, 1), 0.5L);
  EXPECT_EQ(fv(0, 2), 15);  // u^2 + 15 v^2 + exp(u)
  EXPECT_EQ(fv(2, 0), 1.5L);
  EXPECT_EQ(fv(0, 0), 1);
  const Jet<2> fuv = fu.dv(), fvu = fv.du();
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) EXPECT_EQ(fuv(i, j), fvu(i, j));
}

TEST(Jet, TruncationCommutesWithProducts) {
  const Jet<4> u = Jet<4>::u(), v = Jet<4>::v();
  const Jet<4> f = exp(u - v), g = sqrt(Jet<4>(2) + u * v + v);
  const Jet<2> late = (f * g).truncated<2>(), early = f.truncated<2>() * g.truncated<2>();
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) EXPECT_EQ(late(i, j), early(i, j));
}

}  // namespace
