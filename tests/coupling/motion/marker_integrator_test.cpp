// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/marker_integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/allocation_counter.h"

namespace vesiflow::coupling::marker_integrator_test {
namespace {

// Rotation: x' = -y, y' = x from (1, 0); the error at t = 1.
double error_of(MarkerMotion motion, int steps) {
  const auto integrator = make_marker_integrator(motion, 2);
  std::array<double, 2> state{1.0, 0.0};
  const MarkerVelocity rotation = [](double, std::span<const double> x, std::span<double> u) {
    u[0] = -x[1];
    u[1] = x[0];
  };
  for (int i = 0; i < steps; ++i) integrator->advance(1.0 / steps, rotation, state);
  return std::hypot(state[0] - std::cos(1.0), state[1] - std::sin(1.0));
}

double order_of(MarkerMotion motion) {
  return std::log2(error_of(motion, 200) / error_of(motion, 400));
}

TEST(MarkerIntegrator, ConvergesWithItsOrder) {
  EXPECT_NEAR(order_of(MarkerMotion::euler), 1.0, 0.05);
  EXPECT_NEAR(order_of(MarkerMotion::ab2), 2.0, 0.05);
}

TEST(MarkerIntegrator, ContinuesBitForBitFromASavedHistory) {
  const MarkerVelocity velocity = [](double t, std::span<const double> x, std::span<double> u) {
    u[0] = std::sin(x[0]) + t;
  };
  for (const MarkerMotion motion : marker_integrators) {
    if (motion == MarkerMotion::arkode && !have_sundials()) continue;
    const auto whole = make_marker_integrator(motion, 1);
    std::array<double, 1> x{0.7};
    for (int i = 0; i < 5; ++i) whole->advance(0.1, velocity, x);
    const auto continued = make_marker_integrator(motion, 1);
    std::array<double, 1> y = x;
    if (!whole->history().empty()) continued->restore_history(0.1, whole->history());
    for (int i = 0; i < 5; ++i) {
      whole->advance(0.1, velocity, x);
      continued->advance(0.1, velocity, y);
    }
    EXPECT_EQ(x, y) << name(motion);
  }
}

// With steps that alternate between h and 2 h the error still falls with the square of h.
TEST(MarkerIntegrator, AdamsBashforthKeepsItsOrderWithChangingSteps) {
  const auto error = [](int pairs) {
    const auto ab2 = make_marker_integrator(MarkerMotion::ab2, 1);
    const MarkerVelocity growth = [](double, std::span<const double> x, std::span<double> u) { u[0] = x[0]; };
    std::array<double, 1> x{1.0};
    const double h = 1.0 / (3.0 * pairs);
    for (int i = 0; i < pairs; ++i) {
      ab2->advance(h, growth, x);
      ab2->advance(2.0 * h, growth, x);
    }
    return std::abs(x[0] - std::exp(1.0));
  };
  EXPECT_NEAR(std::log2(error(200) / error(400)), 2.0, 0.05);
}

TEST(MarkerIntegrator, RestartForgetsTheHistory) {
  const auto ab2 = make_marker_integrator(MarkerMotion::ab2, 1);
  const MarkerVelocity growth = [](double, std::span<const double> x, std::span<double> u) { u[0] = x[0]; };
  std::array<double, 1> x{1.0};
  ab2->advance(0.1, growth, x);
  ab2->restart();
  ab2->advance(0.2, growth, x);
  EXPECT_DOUBLE_EQ(x[0], 1.1 * 1.2);
}

TEST(MarkerIntegrator, RefusesOtherMotionsAndWrongHistories) {
  EXPECT_THROW(make_marker_integrator(MarkerMotion::shape_following, 1), std::invalid_argument);
  const std::array<double, 1> history{1.0};
  EXPECT_THROW(make_marker_integrator(MarkerMotion::ab2, 2)->restore_history(0.1, history), std::invalid_argument);
}

class Arkode : public testing::Test {
 protected:
  void SetUp() override {
    if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  }

  // Rotation about the origin at the rate 1 + t through one step of length 1: the error at its end.
  static double error_of(const MarkerTolerances& tolerances, MarkerStatistics& statistics) {
    const auto arkode = make_marker_integrator(MarkerMotion::arkode, 2, tolerances);
    std::array<double, 2> x{1.0, 0.0};
    arkode->advance(
        1.0,
        [](double t, std::span<const double> y, std::span<double> u) {
          u[0] = -(1.0 + t) * y[1];
          u[1] = (1.0 + t) * y[0];
        },
        x);
    statistics = arkode->statistics();
    return std::hypot(x[0] - std::cos(1.5), x[1] - std::sin(1.5));
  }
};

// Sub-steps of a method of order three number as the cube root of the tolerance, and the error follows the tolerance.
TEST_F(Arkode, ErrorFollowsTheTolerance) {
  MarkerStatistics coarse, fine;
  const double coarse_error = error_of({0.0, 1e-5}, coarse), fine_error = error_of({0.0, 1e-8}, fine);
  EXPECT_LT(coarse_error, 1e-4);
  EXPECT_LT(fine_error, 1e-7);
  EXPECT_GT(coarse_error / fine_error, 100.0);
  EXPECT_NEAR(static_cast<double>(fine.sub_steps) / static_cast<double>(coarse.sub_steps), 10.0, 4.0);
  EXPECT_GE(fine.evaluations, 3 * fine.sub_steps);
}

// A tolerance that any sub-step meets: one sub-step per step shows the order of the method.
TEST_F(Arkode, HasOrderThreeInTheStep) {
  const auto error = [](int steps) {
    const auto arkode = make_marker_integrator(MarkerMotion::arkode, 2, {0.0, 1e3});
    std::array<double, 2> x{1.0, 0.0};
    const MarkerVelocity rotation = [](double, std::span<const double> y, std::span<double> u) {
      u[0] = -y[1];
      u[1] = y[0];
    };
    for (int i = 0; i < steps; ++i) arkode->advance(1.0 / steps, rotation, x);
    EXPECT_EQ(arkode->statistics().sub_steps, steps);
    return std::hypot(x[0] - std::cos(1.0), x[1] - std::sin(1.0));
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 3.0, 0.1);
}

TEST_F(Arkode, LooksIntoTheStepAndNotBeyond) {
  double least = 1.0, greatest = 0.0;
  const auto arkode = make_marker_integrator(MarkerMotion::arkode, 1, {0.0, 1e-6});
  std::array<double, 1> x{1.0};
  for (int i = 0; i < 3; ++i)
    arkode->advance(
        0.3,
        [&](double t, std::span<const double> y, std::span<double> u) {
          least = std::min(least, t);
          greatest = std::max(greatest, t);
          u[0] = std::cos(20.0 * t) * y[0];
        },
        x);
  EXPECT_EQ(least, 0.0);
  EXPECT_EQ(greatest, 1.0);
}

TEST_F(Arkode, ErrorsOfTheVelocityComeThrough) {
  const auto arkode = make_marker_integrator(MarkerMotion::arkode, 1);
  std::array<double, 1> x{1.0};
  const MarkerVelocity broken = [](double, std::span<const double>, std::span<double>) {
    throw std::domain_error("marker 7 is outside");
  };
  try {
    arkode->advance(0.1, broken, x);
    FAIL() << "was taken";
  } catch (const std::domain_error& error) {
    EXPECT_STREQ(error.what(), "marker 7 is outside");
  }
  // And the integrator is good for another step.
  arkode->advance(
      0.1, [](double, std::span<const double>, std::span<double> u) { u[0] = 2.0; }, x);
  EXPECT_NEAR(x[0], 1.2, 1e-12);
}

TEST_F(Arkode, OwnErrorsAreDomainErrorsThatNameTheFlag) {
  const auto arkode = make_marker_integrator(MarkerMotion::arkode, 1);
  std::array<double, 1> x{1.0};
  try {  // explodes within the step
    arkode->advance(
        2.0, [](double, std::span<const double> y, std::span<double> u) { u[0] = y[0] * y[0]; }, x);
    FAIL() << "was taken";
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("arkode: ARK_"), std::string::npos) << error.what();
  }
}

TEST_F(Arkode, RefusesBadTolerances) {
  EXPECT_THROW(make_marker_integrator(MarkerMotion::arkode, 1, {-1.0, 1e-6}), std::invalid_argument);
  EXPECT_THROW(make_marker_integrator(MarkerMotion::arkode, 1, {0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(make_marker_integrator(MarkerMotion::arkode, 1, {0.0, NAN}), std::invalid_argument);
}

TEST_F(Arkode, StepsAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const auto arkode = make_marker_integrator(MarkerMotion::arkode, 300, {0.0, 1e-5});
  std::vector<double> x(300, 1.0);
  const MarkerVelocity velocity = [](double t, std::span<const double> y, std::span<double> u) {
    for (std::size_t i = 0; i < y.size(); ++i) u[i] = std::cos(9.0 * t + static_cast<double>(i)) * y[i];
  };
  for (int i = 0; i < 3; ++i) arkode->advance(0.5, velocity, x);
  const long before = test::allocation_count();
  for (int i = 0; i < 5; ++i) arkode->advance(0.5, velocity, x);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

TEST(MarkerIntegrator, WithoutSundialsArkodeIsRefusedByNameOfTheOption) {
  if (have_sundials()) GTEST_SKIP() << "built with SUNDIALS";
  try {
    make_marker_integrator(MarkerMotion::arkode, 1);
    FAIL() << "was made";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("VESIFLOW_WITH_SUNDIALS"), std::string::npos);
  }
}

}  // namespace
}  // namespace vesiflow::coupling::marker_integrator_test
