// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/stiffness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/constants.h"
#include "motion/surrounding_fluid.h"

namespace vesiflow::coupling::stiffness_test {
namespace {

constexpr int degrees = 20;
constexpr double radius = 1.2, dt = 1.0 / 24.0;
constexpr Stiffness::Material material{.sigma0 = 300.0, .bending = 0.1};

/// Of a thin membrane.
MembraneResponse response(double a, double mu, int of_degrees = degrees) {
  MembraneResponse modes(of_degrees, radius, 0.0, {});
  modes.update(a, mu);
  return modes;
}

// In Stokes flow a plane sheet answers with 1/(4 mu k); with inertia with what membrane_response_test.cpp has, m^2 =
// k^2 + a/mu.
TEST(Stiffness, IsTheClosedForm) {
  const MembraneCondition condition{.largest_tension = 4.0, .compression = 1.0, .curvature_variance = 0.3};
  const double c = 1.5;
  for (const double a : {0.0, 20.0})
    for (const double mu : {1.0, 3.0}) {
      Stiffness stiffness(degrees, material);
      stiffness.find(dt, condition, {.factor = c}, response(a, mu));
      for (int n = 0; n < degrees; ++n) {
        const double k = (n + 0.5) / radius, m = std::sqrt(k * k + a / mu);
        const double normal = k / (2.0 * mu * m * (m + k)), along = 1.0 / (2.0 * mu * (m + k));
        const double force = c * k * k * (material.bending * k * k + condition.largest_tension);
        EXPECT_NEAR(stiffness[n].position / (dt * force * normal), 1.0, 1e-8) << n;
        EXPECT_NEAR(stiffness[n].position_force, -force, 1e-12 * force) << n;
        EXPECT_EQ(stiffness[n].strain_force, c * material.sigma0) << n;
        if (n > 0) {
          EXPECT_NEAR(stiffness[n].strain / (dt * c * material.sigma0 * k * k * along), 1.0, 1e-8) << n;
        }
      }
      // A uniform tension acts by the variation of the curvature, as a force of degree 2 does.
      const double k2 = 2.5 / radius, m2 = std::sqrt(k2 * k2 + a / mu);
      const double of_degree_2 = k2 / (2.0 * mu * m2 * (m2 + k2));
      EXPECT_NEAR(stiffness[0].strain / (dt * c * material.sigma0 * 0.3 * of_degree_2), 1.0, 1e-8);
    }
}

// In Stokes flow the rates grow with the degree, so that the fastest is that of the highest degree within the
// compression.
TEST(Stiffness, IsThatOfTheShortestWavesOfAPressedMesh) {
  const double compression = 1.7;
  const MembraneCondition condition{.largest_tension = 4.0, .compression = compression};
  const MembraneResponse modes = response(0.0, 1.0, 2 * degrees);
  Stiffness pressed(degrees, material), covered(degrees, material);
  pressed.find(dt, condition, {.factor = 1.5}, modes);
  covered.find(dt, condition, {.factor = 1.5, .covers_compression = true}, modes);
  for (int n = 1; n < degrees; ++n) {
    const auto rate = [&](int m) {
      const double k = (m + 0.5) / radius;
      return k * (material.bending * k * k + 4.0) / 4.0;
    };
    const int shortest = static_cast<int>(std::floor(compression * (n + 0.5) - 0.5));
    EXPECT_NEAR(pressed[n].position / (dt * std::max(1.5 * rate(n), rate(shortest))), 1.0, 1e-8) << n;
    EXPECT_NEAR(covered[n].position / (dt * 1.5 * rate(n)), 1.0, 1e-8) << n;
    // What it says to the fluid goes with it.
    EXPECT_NEAR(-pressed[n].position_force * dt * modes[n].normal.velocity, pressed[n].position, 1e-12) << n;
  }
}

TEST(Stiffness, ForcesAreThoseOfEachDegree) {
  Stiffness stiffness(degrees, material);
  stiffness.find(dt, {.largest_tension = 1.0}, {.factor = 1.5}, response(0.0, 1.0));
  vesicle::Coefficients change(degrees, 4), forces;
  for (int f = 0; f < 4; ++f)
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) change(f, n, m) = {1.0 + f, 0.1 * m};
  stiffness.find_forces(change, forces);
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m <= n; ++m) {
      EXPECT_EQ(forces(1, n, m), stiffness[n].position_force * change(1, n, m));
      EXPECT_EQ(forces(3, n, m), stiffness[n].strain_force * change(3, n, m));
    }
}

TEST(Stiffness, OverestimateGrowsWithInertiaAndWithWhatIsExplicit) {
  const auto factor = [](bool thin, double compression, double inertia, double lag) {
    return overestimate_of_single_correction(thin, compression, inertia, lag).factor;
  };
  EXPECT_EQ(factor(false, 2.0, 0.0, 0.0), constants::overestimate);
  EXPECT_EQ(factor(false, 2.0, 1.0, 0.0), constants::overestimate_with_inertia);
  EXPECT_EQ(factor(true, 2.0, 0.0, 0.0), 4.0 * constants::overestimate);
  EXPECT_EQ(factor(true, 2.0, 1.0, 0.0), 4.0 * constants::overestimate);  // more than inertia asks for
  EXPECT_EQ(factor(false, 1.0, 0.0, 5.0), constants::overestimate + 5.0);
}

// motion/constants.h: 30 in all at ratio 20, 7 at 5, and 9 around a fluid that is 20 times thinner.
TEST(SurroundingFluid, OverestimatesOfAnExplicitViscosityAreAsDocumented) {
  const auto in_all = [](double ratio) {
    SurroundingFluid fluid{.has_inertia = true, .extrapolates_viscosity = true};
    fluid.set_viscosities({ratio, std::max(1.0, ratio), true});
    EXPECT_DOUBLE_EQ(fluid.solved_viscosity - fluid.explicit_viscosity, 0.5 * (1.0 + ratio));
    return constants::overestimate + fluid.lagging_overestimate();
  };
  EXPECT_NEAR(in_all(20.0), 30.0, 2.0);
  EXPECT_NEAR(in_all(5.0), 7.0, 1.0);
  EXPECT_NEAR(in_all(0.05), 9.0, 0.5);
}

TEST(SurroundingFluid, OwesNothingWhereTheSolveHasAllOfTheViscosity) {
  SurroundingFluid fluid{.has_inertia = true, .reynolds_number = 2.0};
  fluid.set_viscosities({7.0, 7.0, false});
  EXPECT_EQ(fluid.solved_viscosity, 4.0);
  EXPECT_EQ(fluid.remembered_viscosity(), 0.0);
  EXPECT_EQ(fluid.lagging_overestimate(), 0.0);
  EXPECT_DOUBLE_EQ(fluid.acceleration(0.1, Bdf2::of(0.1, 0.1)), 30.0);
  EXPECT_DOUBLE_EQ(fluid.inertia_share(4.0, 1.0), 0.5);
}

}  // namespace
}  // namespace vesiflow::coupling::stiffness_test
