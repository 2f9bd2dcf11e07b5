// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/bdf2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "motion/constants.h"

namespace vesiflow::coupling::bdf2_test {
namespace {

TEST(Bdf2, IsExactForQuadraticsWhateverTheSteps) {
  const auto y = [](double t) { return 0.3 - 1.7 * t + 2.1 * t * t; };
  const auto slope = [](double t) { return -1.7 + 4.2 * t; };
  for (const double last_dt : {0.1, 0.25, 0.7})
    for (const double dt : {0.05, 0.25, 0.4}) {
      const Bdf2 scheme = Bdf2::of(dt, last_dt);
      const double t = 0.8, d = y(t) - y(t - dt), last = y(t - dt) - y(t - dt - last_dt);
      EXPECT_NEAR(scheme.leading * d, scheme.last * last + dt * slope(t), 1e-13);
    }
}

TEST(Bdf2, BeginsWithBackwardEulerAndNoExtrapolation) {
  const Bdf2 scheme = Bdf2::of(0.1, 0.0);
  EXPECT_EQ(scheme.ratio, 0.0);
  EXPECT_EQ(scheme.leading, 1.0);
  EXPECT_EQ(scheme.last, 0.0);
}

/// Greatest factor by which what is left of a mode that relaxes at z/dt can grow in a step with implicit terms Z:
/// (a0 + Z) d' = (a1 + Z) d - z (y + d), for equal steps.
double growth(double stiffness, double z) {
  const Bdf2 scheme = Bdf2::of(1.0, 1.0);
  // Roots q of (a0 + Z)(q^2 - q) - (a1 + Z)(q - 1) + z (2 q - 1) = 0.
  const double a = scheme.leading + stiffness, b = -(a + scheme.last + stiffness) + 2.0 * z,
               c = scheme.last + stiffness - z;
  const std::complex<double> root = std::sqrt(std::complex<double>(b * b - 4.0 * a * c));
  return std::max(std::abs((-b + root) / (2.0 * a)), std::abs((-b - root) / (2.0 * a)));
}

// The lower bound of the stiffness (motion/constants.h): 4 + 4 Z >= 3 z.
TEST(Bdf2, NeedsThreeQuartersOfTheTrueRateAndNoMore) {
  for (const double z : {10.0, 100.0, 1e4}) {
    const double least = 0.75 * z - 1.0;
    EXPECT_NEAR(growth(least, z), 1.0, 1e-9) << z;
    EXPECT_GT(growth(0.99 * least, z), 1.0) << z;
    for (const double factor : {1.01, constants::overestimate, constants::overestimate_with_inertia, 30.0})
      EXPECT_LT(growth(factor * std::max(least, 0.8 * z), z), 1.0) << z << ' ' << factor;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::bdf2_test
