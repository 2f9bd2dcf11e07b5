// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Steps whose solves are in single precision, beside those in double precision.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "support/allocation_counter.h"
#include "test_fields.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_precision_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid box({0, -1, 0}, {1, 2, 2}, {24, 27, 20});

struct Case {
  const char* name;
  test::Topology topology;
  FluidParameters parameters;
  bool variable = false;
};

const Case cases[] = {
    {"walls", {}, {}},
    {"walls_re_small", {}, {.reynolds_number = 1e-3}},
    {"walls_re_large", {}, {.reynolds_number = 100.0}},
    {"walls_unsteady", {}, {.inertia = Inertia::unsteady}},
    {"periodic", {.periodic = 7}, {}},
    {"channel", {.periodic = 3}, {}},
    {"mirror", {.mirror = 2}, {}},
    {"periodic_and_mirror", {.periodic = 1, .mirror = 4}, {}},
    {"explicit", {}, {.viscous_treatment = ViscousTreatment::explicit_}, true},
    {"extrapolated", {.periodic = 2}, {.viscous_treatment = ViscousTreatment::extrapolated}, true},
    {"implicit", {}, {.viscous_treatment = ViscousTreatment::implicit}, true},
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

// Walls that move in their own planes and, without mirrors, blow through.
Vector3 stirring(const Grid& grid, const Vector3& r, double t) {
  constexpr double turn = 2.0 * std::numbers::pi;
  Vector3 u{std::sin(turn * r[2] / 2 + 3 * t), std::cos(turn * r[0] - t), 0.5 * std::sin(turn * r[1] / 3) * t};
  for (int axis = 0; axis < 3; ++axis) {
    const bool mirrors = grid.mirror[0] || grid.mirror[1] || grid.mirror[2];
    const bool on_wall = r[axis] == grid.lower[axis] || r[axis] == grid.upper[axis];
    if (mirrors && on_wall) u[axis] = 0.0;
  }
  return u;
}

NavierStokes started(const Case& c, Precision precision) {
  const Grid grid = test::with_topology(box, c.topology);
  FluidParameters parameters = c.parameters;
  parameters.precision = precision;
  if (c.variable) parameters.viscosity = test::wavy_viscosity(grid, 5.0);
  NavierStokes fluid(
      grid, parameters, [grid](const Vector3& r, double t) { return stirring(grid, r, t); }, WallMotion::unsteady);
  fluid.set_velocity([&](const Vector3& r) { return stirring(grid, r, 0.5); });
  return fluid;
}

// Smooth and growing, rough at the scale of the grid as what membranes spread is, and now and then another step.
void advance(NavierStokes& fluid, int steps) {
  for (int k = 0; k < steps; ++k) {
    for (const View& component : fluid.force().unknowns())
      test::fill_random(component, static_cast<unsigned>(3 + fluid.steps() / 10));
    fluid.uniform_force() = {std::sin(fluid.time()), 0.3, 0.0};
    fluid.step(fluid.steps() % 7 == 0 ? 0.01 : 0.008);
  }
}

double largest(const NavierStokes& fluid) {
  double result = 0.0;
  for (const ConstView& component : fluid.velocity().points()) result = std::max(result, test::max_abs(component));
  return result;
}

double relative_divergence(const NavierStokes& fluid) {
  return max_divergence(fluid.velocity()) * fluid.grid().min_spacing() / largest(fluid);
}

class MixedPrecision : public testing::TestWithParam<Case> {};

TEST_P(MixedPrecision, IsTheFlowOfDoublePrecisionToOneInAMillion) {
  NavierStokes exact = started(GetParam(), Precision::double_), mixed = started(GetParam(), Precision::mixed);
  for (int k = 0; k < 100; ++k) {
    advance(exact, 1);
    advance(mixed, 1);
    ASSERT_LT(relative_divergence(mixed), 1e-13) << "after step " << k + 1;  // round-off of double precision
  }
  const double difference = test::max_difference(exact.velocity(), mixed.velocity()) / largest(exact);
  EXPECT_LT(difference, 1e-6);
  EXPECT_GT(difference, 0.0);  // they are two
  EXPECT_LT(test::max_difference(exact.pressure().points(), mixed.pressure().points()),
            1e-5 * test::max_abs(exact.pressure().points()));
}

TEST_P(MixedPrecision, ContinuesARestoredStateBitForBit) {
  NavierStokes fluid = started(GetParam(), Precision::mixed), restored = started(GetParam(), Precision::mixed);
  advance(fluid, 4);
  advance(restored, 1);
  restored.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
  advance(fluid, 4);
  advance(restored, 4);
  EXPECT_TRUE(test::same_bits(fluid.velocity(), restored.velocity()));
  EXPECT_EQ(test::max_difference(fluid.pressure().points(), restored.pressure().points()), 0.0);
}

TEST_P(MixedPrecision, LeavesNoTraceOfAStepThatIsTakenBack) {
  NavierStokes straight = started(GetParam(), Precision::mixed), tried = started(GetParam(), Precision::mixed);
  for (int k = 0; k < 3; ++k) {
    tried.remember();
    advance(tried, 1);
    tried.retry();
    advance(straight, 1);
    advance(tried, 1);
    EXPECT_TRUE(test::same_bits(straight.velocity(), tried.velocity()));
  }
}

TEST_P(MixedPrecision, HasTheSameBitsForEveryNumberOfThreads) {
  const Grid large = Grid(box.lower, box.upper, {31, 29, 26});  // small ones are left to one thread
  const auto run = [&](int threads) {
    const test::ThreadCount count(threads);
    FluidParameters parameters = GetParam().parameters;
    parameters.precision = Precision::mixed;
    const Grid grid = test::with_topology(large, GetParam().topology);
    if (GetParam().variable) parameters.viscosity = test::wavy_viscosity(grid, 5.0);
    NavierStokes fluid(
        grid, parameters, [grid](const Vector3& r, double t) { return stirring(grid, r, t); }, WallMotion::unsteady);
    advance(fluid, 3);
    return fluid;
  };
  const NavierStokes one = run(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(test::same_bits(one.velocity(), run(threads).velocity())) << threads;
}

TEST_P(MixedPrecision, AllocatesNothingInAWarmedUpStep) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // a team of one is allocated by libgomp
  NavierStokes fluid = started(GetParam(), Precision::mixed);
  for (int k = 0; k < 3; ++k) fluid.step(0.01);
  const long before = vesiflow::test::allocation_count();
  for (int k = 0; k < 2; ++k) fluid.step(0.01);
  EXPECT_EQ(vesiflow::test::allocation_count(), before);
}

INSTANTIATE_TEST_SUITE_P(All, MixedPrecision, testing::ValuesIn(cases),
                         [](const auto& c) { return std::string(c.param.name); });

// A force that is solved for again and again is an increment each time.
TEST(MixedPrecisionSolveAgain, GivesWhatTheStepWithTheForceOfNowGives) {
  for (const Case& c : {cases[0], cases[4], cases[7]}) {
    SCOPED_TRACE(c.name);
    NavierStokes once = started(c, Precision::double_), again = started(c, Precision::mixed);
    again.keep_force();
    const auto force = [](NavierStokes& fluid, unsigned seed) {
      for (const View& component : fluid.force().unknowns()) test::fill_random(component, seed++);
    };
    for (NavierStokes* fluid : {&once, &again}) {
      force(*fluid, 12);
      fluid->step(0.1);
    }
    force(again, 55);
    again.step(0.07);
    for (const unsigned seed : {66U, 77U}) {
      force(again, seed);
      again.solve_again();
    }
    force(once, 77);
    once.step(0.07);
    EXPECT_LT(test::max_difference(once.velocity(), again.velocity()), 1e-6 * largest(once));
    EXPECT_LT(relative_divergence(again), 1e-13);
  }
}

TEST(MixedPrecisionParameters, AreRefusedByNameWhereTheyMeanNothing) {
  EXPECT_THAT(
      [&] {
        NavierStokes(box, {.inertia = Inertia::none, .precision = Precision::mixed},
                     [](const Vector3&, double) { return Vector3{}; });
      },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("precision is mixed"), HasSubstr("no inertia"))));
  const EllipticProblem problem = EllipticProblem::pressure(box);
  const FftOptions reference{FftOptions::Transforms::fftw_r2r, FftOptions::Arithmetic::single};
  EXPECT_THAT(
      [&] { make_elliptic_solver(problem, reference); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("arithmetic"), HasSubstr("single"), HasSubstr("fftw_r2r"))));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_precision_test
