// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fluid/convection_stability.h"
#include "fluid/navier_stokes.h"
#include "test_fields.h"

namespace vesiflow::fluid::convection_stability_test {
namespace {

// Shear waves v(x) in a uniform stream, of all lengths that the periodic grid has: largest |v| after so many steps.
double after(int steps, double speed, double reynolds_number, double dt) {
  const Grid grid({0, 0, 0}, {4, 1, 1}, {64, 8, 8}, {.periodic = {true, true, true}});
  FluidParameters parameters;
  parameters.reynolds_number = reynolds_number;
  NavierStokes fluid(grid, parameters);
  fluid.set_velocity([&](const Vector3& x) {
    // A narrow bump, which has them all.
    return Vector3{speed, 1e-6 * std::exp(-std::pow(16 * (x[0] - 2), 2)), 0.0};
  });
  for (int k = 0; k < steps; ++k) fluid.step(dt);
  return test::max_abs(fluid.velocity().y.points());
}

// Pe = Re U h of 0.5 to 8, h = 1/16.
TEST(StableConvectionStep, IsThatOfTheStep) {
  for (const double peclet : {0.5, 2.0, 8.0}) {
    const double speed = 3.0, reynolds_number = 16 * peclet / speed;
    const double limit = stable_convection_step(speed, 1.0 / 16, reynolds_number);
    EXPECT_LT(after(400, speed, reynolds_number, 0.97 * limit), 1e-6) << peclet;
    EXPECT_GT(after(400, speed, reynolds_number, 1.2 * limit), 1e-5) << peclet;
  }
}

// From solving the same recurrence independently (companion matrices, 120 phases): C at m = 20 and Pe = 1, 5.6.
TEST(StableConvectionStep, IsShorterWithAnExtrapolatedViscousTerm) {
  const double speed = 2.0, h = 0.1;
  const auto courant = [&](double peclet, double m, ViscousTreatment treatment) {
    return stable_convection_step(speed, h, peclet / (speed * h), m, treatment) * speed / h;
  };
  EXPECT_NEAR(courant(1.0, 20, ViscousTreatment::extrapolated), 0.346, 0.004);
  EXPECT_NEAR(courant(5.6, 20, ViscousTreatment::extrapolated), 0.240, 0.003);
  EXPECT_NEAR(courant(5.6, 20, ViscousTreatment::explicit_), 3.643, 0.04);
  EXPECT_NEAR(courant(5.6, 20, ViscousTreatment::implicit), 0.661, 0.007);
  EXPECT_NEAR(courant(5.6, 1, ViscousTreatment::extrapolated), 0.661, 0.007);
}

TEST(StableConvectionStep, IsInfiniteWithoutConvection) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(stable_convection_step(0.0, 0.1, 1.0), infinite);
  EXPECT_EQ(stable_convection_step(1.0, 0.1, 0.0), infinite);
}

}  // namespace
}  // namespace vesiflow::fluid::convection_stability_test
