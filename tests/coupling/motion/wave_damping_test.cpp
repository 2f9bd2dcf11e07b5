// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/wave_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace vesiflow::coupling::wave_damping_test {
namespace {

WaveDamping damping_of(int degrees, double radius, double speed) {
  WaveDamping damping(degrees, radius);
  damping.update(speed);
  return damping;
}

// A rate: what matters is how far, in radii, the membrane is swept along.
TEST(WaveDamping, IsInProportionToTheRateAtWhichTheMembraneIsSweptAlong) {
  const WaveDamping damping = damping_of(20, 1.2, 0.6), faster = damping_of(20, 1.2, 1.8),
                    larger = damping_of(20, 3.6, 0.6);
  EXPECT_EQ(damping[0], 0.0);  // where the membrane is
  for (int n = 1; n < 20; ++n) {
    EXPECT_GT(damping[n], damping[n - 1]);
    EXPECT_NEAR(faster[n] / damping[n], 3.0, 1e-12);
    EXPECT_NEAR(larger[n] / damping[n], 1.0 / 3.0, 1e-12);
  }
}

// The highest degree is as short as the grid resolves, whatever its number: a finer grid damps shorter waves alike.
TEST(WaveDamping, IsThatOfTheShareOfTheHighestDegree) {
  const WaveDamping coarse = damping_of(11, 1.0, 0.5), fine = damping_of(31, 1.0, 0.5);
  for (int n = 1; n < 11; ++n) EXPECT_NEAR(coarse[n] / fine[3 * n], 1.0, 1e-12) << n;
}

// On half of the damping waves of degree 30 to 34, the highest that were kept, doubled every 0.85 units of time (shear of rate 1, R/h =
// 11.5; validation/studies/integrators.md). A membrane is swept along at about half the shear rate there, as a sphere turns: the other half must
// hold them.
TEST(WaveDamping, HoldsTheWavesThatGrewOnHalfOfIt) {
  const WaveDamping damping = damping_of(35, 1.0, 0.5);
  for (int n = 30; n < 35; ++n) EXPECT_GT(0.5 * damping[n], std::log(2.0) / 0.85) << n;
}

// Bending moves a degree at the rate k^3/(16 Ca), k = n + 1/2: the answer 1/(4 k) of a plane sheet in Stokes flow to the force k^4/(4 Ca).
// What is damped of the lower half of the degrees, which the fluid resolves well, is to be nothing beside it.
TEST(WaveDamping, LeavesTheLowerHalfOfTheDegreesToTheMembrane) {
  constexpr double capillary_number = 2.5;
  for (const int degrees : {11, 21, 41}) {
    const WaveDamping damping = damping_of(degrees, 1.0, 0.5);
    for (int n = 2; n <= degrees / 2; ++n)
      EXPECT_LT(damping[n], 0.01 * std::pow(n + 0.5, 3) / (16.0 * capillary_number)) << n << " of " << degrees;
  }
}

TEST(WaveDamping, IsSubtractedDegreeByDegree) {
  constexpr int degrees = 20;
  const WaveDamping damping = damping_of(degrees, 1.2, 0.6);
  vesicle::Coefficients rates(degrees, 1), y(degrees, 1);
  rates.set_zero();
  y.set_zero();
  rates(0, 7, 3) = {0.5, 0.25};
  y(0, 7, 3) = {2.0, -1.0};
  damping.subtract_from(rates, y);
  const std::complex<double> left = std::complex<double>(0.5, 0.25) - damping[7] * std::complex<double>(2.0, -1.0);
  EXPECT_LT(std::abs(rates(0, 7, 3) - left), 1e-15);
  EXPECT_EQ(rates(0, 6, 3), std::complex<double>());
}

}  // namespace
}  // namespace vesiflow::coupling::wave_damping_test
