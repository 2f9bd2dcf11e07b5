// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/coefficients.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"
#include "support/allocation_counter.h"

namespace vesiflow::vesicle::coefficients_test {
namespace {

using testing::random_coefficients;

TEST(Coefficients, ResamplePadsWithZerosOrTruncates) {
  const Coefficients given = random_coefficients(7, 2, 1);
  for (int degrees : {1, 2, 5, 7, 8, 16}) {
    Coefficients c = random_coefficients(degrees + 3, 4, 2);
    c.resample(given, degrees);
    ASSERT_EQ(c.degrees(), degrees);
    ASSERT_EQ(c.fields(), 2);
    for (int field = 0; field < 2; ++field)
      for (int n = 0; n < degrees; ++n)
        for (int m = 0; m <= n; ++m)
          EXPECT_EQ(c(field, n, m), n < 7 ? given(field, n, m) : Coefficients::Complex{}) << n << ' ' << m;
  }
}

TEST(Coefficients, ResamplingUpwardsKeepsTheField) {
  const SphereGrid coarse(9), fine(14);
  const Coefficients c = random_coefficients(9, 1, 3);
  Coefficients more;
  more.resample(c, 14);
  ScalarField direct(fine.size()), resampled(fine.size());
  SphericalHarmonics(9, fine).synthesis(c, direct);
  SphericalHarmonics(14, fine).synthesis(more, resampled);
  EXPECT_LT((direct - resampled).abs().maxCoeff(), 1e-14 * direct.abs().maxCoeff());
}

TEST(Coefficients, ReshapingWithinTheCapacityDoesNotAllocate) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const Coefficients given = random_coefficients(8, 3, 4);
  Coefficients c(16, 3);
  const long before = test::allocation_count();
  c.resample(given, 16);
  c.resample(given, 5);
  c.resize(16, 3);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

TEST(Coefficients, TwoThirdsRuleKeepsTwoThirds) {
  for (int degrees : {3, 4, 5, 6, 32}) {
    Coefficients c = random_coefficients(degrees, 1, 5);
    const Coefficients given = c;
    c.truncate_to_two_thirds();
    for (int n = 0; n < degrees; ++n)
      EXPECT_EQ(c(0, n, n), 3 * n < 2 * degrees ? given(0, n, n) : Coefficients::Complex{}) << degrees << ' ' << n;
  }
}

TEST(Coefficients, ExponentialFilterFollowsItsFormula) {
  Coefficients c = random_coefficients(13, 2, 6);
  const Coefficients given = c;
  c.filter_exponentially(36, 8);
  for (int n = 0; n < 13; ++n)
    for (int m = 0; m <= n; ++m)
      EXPECT_LT(std::abs(c(1, n, m) - given(1, n, m) * std::exp(-36 * std::pow(n / 12.0, 8))), 1e-16);
  Coefficients constant = random_coefficients(1, 1, 7);
  const Coefficients::Complex mean = constant(0, 0, 0);
  constant.filter_exponentially(36, 2);
  EXPECT_EQ(constant(0, 0, 0), mean);
  EXPECT_THROW(c.filter_exponentially(-1, 2), std::invalid_argument);
  EXPECT_THROW(c.filter_exponentially(1, 0), std::invalid_argument);
}

/// Against Gauss quadrature of the product of the fields.
TEST(Coefficients, DotIsTheIntegralOverTheSphere) {
  const SphereGrid grid(12);
  const SphericalHarmonics harmonics(12, grid);
  const Coefficients a = random_coefficients(12, 2, 8), b = random_coefficients(12, 2, 9);
  Eigen::ArrayXXd f(grid.size(), 2), g(grid.size(), 2);
  harmonics.synthesis(a, f);
  harmonics.synthesis(b, g);
  double integral = 0;
  for (int j = 0; j < 12; ++j)
    integral +=
        grid.weight()[j] * grid.longitude_spacing() * (f * g).middleRows(grid.index(0, j), grid.longitudes()).sum();
  EXPECT_NEAR(a.dot(b), integral, 1e-12);
  EXPECT_DOUBLE_EQ(a.dot(a), a.energy(0, 12));
  EXPECT_THROW(a.dot(random_coefficients(11, 2, 1)), std::invalid_argument);
  EXPECT_THROW(a.dot(random_coefficients(12, 1, 1)), std::invalid_argument);
}

TEST(Coefficients, EnergiesPerDegree) {
  const Coefficients c = random_coefficients(9, 3, 10);
  ScalarField energies;
  c.energy_per_degree(energies);
  ASSERT_EQ(energies.size(), 9);
  for (int n = 0; n < 9; ++n) EXPECT_DOUBLE_EQ(energies[n], c.energy(n, n + 1));
  Coefficients lone(9, 1);
  lone.set_zero();
  lone(0, 5, 0) = 3;
  lone(0, 5, 2) = {1, 2};
  lone.energy_per_degree(energies);
  EXPECT_DOUBLE_EQ(energies[5], 9 + 2 * 5);
  EXPECT_EQ(energies.sum(), energies[5]);
}

TEST(Coefficients, RefusesBadShapes) {
  Coefficients c;
  EXPECT_THROW(c.resize(0, 1), std::invalid_argument);
  EXPECT_THROW(c.resize(1, 0), std::invalid_argument);
  c.resize(3, 1);
  EXPECT_THROW(c.resample(c, 5), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::coefficients_test
