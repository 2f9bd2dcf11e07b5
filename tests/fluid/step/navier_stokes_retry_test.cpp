// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Steps that are tried, taken back and repeated.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fluid/navier_stokes.h"
#include "test_fields.h"

namespace vesiflow::fluid::navier_stokes_retry_test {
namespace {

const Grid grid({0, -1, 0}, {1, 2, 5}, {8, 9, 10});

// Walls that move in their own planes and blow through, with zero net flux at all times.
Vector3 stirring(const Vector3& r, double t) {
  return {std::sin(r[2] + 3 * t), std::cos(r[0] - t), 0.5 * std::sin(r[1]) * t};
}

Vector3 swirl(const Vector3& r) {
  return {std::sin(r[1]) + 0.2 * r[2], std::cos(r[2]), std::sin(2 * r[0])};
}

void set_random_force(NavierStokes& fluid, unsigned seed) {
  for (const View& component : fluid.force().unknowns()) test::fill_random(component, seed++);
}

NavierStokes started(const FluidParameters& parameters) {
  NavierStokes fluid(grid, parameters, stirring, WallMotion::unsteady);
  fluid.set_velocity(swirl);
  set_random_force(fluid, 12);
  return fluid;
}

void expect_same(const NavierStokes& a, const NavierStokes& b) {
  EXPECT_TRUE(test::same_bits(a.velocity(), b.velocity()));
  EXPECT_TRUE(test::same_bits(a.previous_velocity(), b.previous_velocity()));
  EXPECT_TRUE(std::equal(a.pressure().data(), a.pressure().data() + a.pressure().size(), b.pressure().data()));
  EXPECT_EQ(a.time(), b.time());
  EXPECT_EQ(a.clock().previous_time, b.clock().previous_time);
  EXPECT_EQ(a.clock().time_step, b.clock().time_step);
  EXPECT_EQ(a.steps(), b.steps());
}

// Trial steps of other lengths and forces leave no trace, whether they are the first step or a later one, and whatever terms
// the equations have.
TEST(NavierStokesRetry, ATrialStepLeavesNoTrace) {
  for (const Inertia inertia : {Inertia::full, Inertia::unsteady, Inertia::none}) {
    FluidParameters parameters;
    parameters.inertia = inertia;
    NavierStokes straight = started(parameters), tried = started(parameters);
    for (int k = 0; k < 4; ++k) {
      tried.remember();
      for (const double dt : {0.05, 0.013}) {
        set_random_force(tried, 99);
        tried.step(dt);
        tried.retry();
      }
      set_random_force(tried, 12);
      expect_same(straight, tried);
      straight.step(0.02);
      tried.step(0.02);
      expect_same(straight, tried);
    }
  }
}

TEST(NavierStokesRetry, GoesBackAfterAStepThatFailed) {
  NavierStokes straight = started({}), tried = started({});
  for (int k = 0; k < 3; ++k) {
    tried.remember();
    tried.force().y.fill(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(tried.step(0.02), std::runtime_error);
    tried.retry();
    set_random_force(tried, 12);
    straight.step(0.02);
    tried.step(0.02);
    expect_same(straight, tried);
  }
}

TEST(NavierStokesRetry, RefusesWhatIsNotRemembered) {
  NavierStokes fluid = started({});
  EXPECT_THROW(fluid.retry(), std::logic_error);
  fluid.remember();
  fluid.step(0.02);
  fluid.step(0.02);
  EXPECT_THROW(fluid.retry(), std::logic_error);
  fluid.remember();
  fluid.set_velocity(swirl);
  EXPECT_THROW(fluid.retry(), std::logic_error);
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_retry_test
