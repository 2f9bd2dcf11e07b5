// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/step_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupling/flow.h"

namespace vesiflow::coupling::step_control_test {
namespace {

SimulationParameters adaptive_steps() {
  SimulationParameters parameters;
  parameters.vesicles.emplace_back().reduced_volume = 0.9;
  parameters.time.adaptive = true;
  parameters.time.step = 1e-3;
  parameters.time.smallest_step = 1e-6;
  parameters.time.largest_step = 0.2;
  parameters.time.end = 10.0;
  return parameters;
}

StepControl control_of(const SimulationParameters& parameters) {
  return {parameters, shear_flow(1.0, parameters.domain)};
}

StepErrors position_error(double error) {
  StepErrors errors;
  errors.position = error;
  return errors;
}

// Steps of a scheme whose error is c dt^2 settle where the error e, in tolerances, asks for no change that is worth one: 0.9 e^-0.15 is
// between 0.9 and 1.1 for e from 0.262 to 1, so that dt is at least the root of 0.262 of what would meet the tolerance.
TEST(StepControl, SettlesAtTheToleranceOfAFirstOrderScheme) {
  for (const double c : {0.02, 1.0, 50.0}) {
    SimulationParameters parameters = adaptive_steps();
    parameters.time.largest_step = 10.0;
    parameters.time.end = 1e9;
    StepControl control = control_of(parameters);
    double dt = 0.0;
    int refused = 0;
    for (int step = 0; step < 200; ++step) {
      dt = control.next(0.0);
      refused += control.accepts(dt, position_error(c * dt * dt)) ? 0 : 1;
    }
    const double at_tolerance = std::sqrt(parameters.time.tolerance / c);
    EXPECT_LE(dt, at_tolerance);
    EXPECT_GT(dt, std::sqrt(0.262) * at_tolerance);
    EXPECT_LE(refused, 3);
  }
}

TEST(StepControl, GrowsByHalfAtMostAndNotAfterARefusal) {
  StepControl control = control_of(adaptive_steps());
  const double first = control.next(0.0);
  EXPECT_EQ(first, 1e-3);
  ASSERT_TRUE(control.accepts(first, position_error(0.0)));
  EXPECT_DOUBLE_EQ(control.next(0.0), 1.5 * first);
  const double second = control.next(0.0);
  EXPECT_FALSE(control.accepts(second, position_error(1.0)));
  EXPECT_DOUBLE_EQ(control.next(0.0), 0.2 * second);  // no shorter, however large the error
  EXPECT_NE(control.reason().find("position error is 1 where 2e-05 is allowed"), std::string::npos);
  const double third = control.next(0.0);
  ASSERT_TRUE(control.accepts(third, position_error(0.0)));
  EXPECT_DOUBLE_EQ(control.next(0.0), third);
  ASSERT_TRUE(control.accepts(third, position_error(0.0)));
  EXPECT_DOUBLE_EQ(control.next(0.0), 1.5 * third);
}

// Each limit refuses by itself and is named; so does what is not finite.
TEST(StepControl, WeighsAreasAndVolumesToo) {
  const SimulationParameters parameters = adaptive_steps();
  StepErrors area = position_error(0.0), volume = area;
  area.area_change = 1.1 * parameters.limits.area_error;
  volume.volume_change = 1.1 * parameters.limits.volume_error;
  StepControl control = control_of(parameters);
  const double dt = control.next(0.0);
  EXPECT_FALSE(control.accepts(dt, area));
  EXPECT_NE(control.reason().find("area changes by"), std::string::npos);
  EXPECT_FALSE(control.accepts(dt, volume));
  EXPECT_NE(control.reason().find("volume changes by"), std::string::npos);
  EXPECT_FALSE(control.accepts(dt, position_error(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_DOUBLE_EQ(control.next(0.0), 0.25 * dt);
}

TEST(StepControl, EndsOnTheEndWithTheLastTwoStepsAlike) {
  SimulationParameters parameters = adaptive_steps();
  parameters.time.step = 0.1;
  const StepControl control = control_of(parameters);
  EXPECT_EQ(control.next(0.0), 0.1);
  constexpr double round_off = 1e-14;  // of 10 - 9.85
  EXPECT_NEAR(control.next(9.85), 0.075, round_off);
  EXPECT_NEAR(control.next(9.925), 0.075, round_off);
  EXPECT_NEAR(control.next(9.95), 0.05, round_off);
}

TEST(StepControl, StaysWithinItsBounds) {
  const SimulationParameters parameters = adaptive_steps();
  StepControl control = control_of(parameters);
  for (int step = 0; step < 100; ++step) control.accepts(control.next(0.0), position_error(0.0));
  EXPECT_EQ(control.next(0.0), parameters.time.largest_step);
  for (int step = 0; step < 100; ++step) control.fail(control.next(0.0));
  EXPECT_EQ(control.next(0.0), parameters.time.smallest_step);
  EXPECT_TRUE(control.is_smallest(control.next(0.0)));
}

TEST(StepControl, GoesOnFromItsState) {
  StepControl control = control_of(adaptive_steps()), continued = control_of(adaptive_steps());
  control.accepts(control.next(0.0), position_error(1e-6));
  control.accepts(control.next(0.0), position_error(1e-4));
  continued.restore(control.state());
  for (int step = 0; step < 5; ++step) {
    EXPECT_EQ(continued.next(0.0), control.next(0.0));
    const double dt = control.next(0.0);
    EXPECT_EQ(continued.accepts(dt, position_error(dt * dt)), control.accepts(dt, position_error(dt * dt)));
  }
  EXPECT_THROW(continued.restore(std::vector<double>{1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(continued.restore(std::vector<double>{0.0, 1.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::step_control_test
