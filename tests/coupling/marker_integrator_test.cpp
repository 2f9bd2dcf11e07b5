#include "coupling/marker_integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace vesiflow::coupling {
namespace {

// Rotation: x' = -y, y' = x from (1, 0); the error at t = 1.
double error_of(const char* name, int steps) {
  const auto integrator = make_marker_integrator(name, 2);
  std::array<double, 2> state{1.0, 0.0};
  const MarkerVelocity rotation = [](std::span<const double> x, std::span<double> u) {
    u[0] = -x[1];
    u[1] = x[0];
  };
  for (int i = 0; i < steps; ++i) integrator->advance(1.0 / steps, rotation, state);
  return std::hypot(state[0] - std::cos(1.0), state[1] - std::sin(1.0));
}

double order_of(const char* name) {
  return std::log2(error_of(name, 200) / error_of(name, 400));
}

TEST(MarkerIntegrator, ConvergesWithItsOrder) {
  EXPECT_NEAR(order_of("euler"), 1.0, 0.05);
  EXPECT_NEAR(order_of("ab2"), 2.0, 0.05);
}

TEST(MarkerIntegrator, ContinuesBitForBitFromASavedHistory) {
  const MarkerVelocity velocity = [](std::span<const double> x, std::span<double> u) { u[0] = std::sin(x[0]); };
  for (const auto name : marker_integrators) {
    const auto whole = make_marker_integrator(name, 1);
    std::array<double, 1> x{0.7};
    for (int i = 0; i < 5; ++i) whole->advance(0.1, velocity, x);
    const auto continued = make_marker_integrator(name, 1);
    std::array<double, 1> y = x;
    if (!whole->history().empty()) continued->restore_history(0.1, whole->history());
    for (int i = 0; i < 5; ++i) {
      whole->advance(0.1, velocity, x);
      continued->advance(0.1, velocity, y);
    }
    EXPECT_EQ(x, y) << name;
  }
}

TEST(MarkerIntegrator, StartsAfreshWhenTheStepChanges) {
  const auto ab2 = make_marker_integrator("ab2", 1);
  const MarkerVelocity growth = [](std::span<const double> x, std::span<double> u) { u[0] = x[0]; };
  std::array<double, 1> x{1.0};
  ab2->advance(0.1, growth, x);
  ab2->advance(0.2, growth, x);
  EXPECT_DOUBLE_EQ(x[0], 1.1 * 1.2);
}

TEST(MarkerIntegrator, RefusesUnknownNamesAndWrongHistories) {
  EXPECT_THROW(make_marker_integrator("rk9", 1), std::invalid_argument);
  const std::array<double, 1> history{1.0};
  EXPECT_THROW(make_marker_integrator("ab2", 2)->restore_history(0.1, history), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling
