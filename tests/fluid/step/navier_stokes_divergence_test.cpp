// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Steps of a flow with a divergence that is given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "flow_with_divergence.h"
#include "fluid/operators.h"
#include "manufactured_flow.h"
#include "support/allocation_counter.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_divergence_test {
namespace {

using test::FlowWithDivergence;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr AxisEnds channel{.periodic = {true, true, false}};
constexpr AxisEnds all_periodic{.periodic = {true, true, true}};
constexpr Inertia all_inertias[] = {Inertia::full, Inertia::unsteady, Inertia::none};

Grid unequal(const AxisEnds& ends) {
  return {{-1, 0, 0}, {1, 3, 1}, {11, 8, 13}, ends};
}

// Walls that move in their own planes and blow through, with zero net flux at all times, also where the box repeats.
Vector3 stirring(const Vector3& r, double t) {
  constexpr double pi = std::numbers::pi;
  return {std::sin(pi * (r[0] + r[2]) + 3 * t), std::cos(2 * pi / 3 * r[1] + pi * r[2] - t),
          0.5 * std::sin(pi * (r[0] + r[2])) * t};
}

double mean(const Field<Cell>& field) {
  double sum = 0.0;
  test::for_each_point(field.extent(), [&](int i, int j, int k) { sum += field(i, j, k); });
  return sum / static_cast<double>(field.grid().cell_count());
}

void set_random_force(NavierStokes& fluid, unsigned seed) {
  for (const View& component : fluid.force().unknowns()) test::fill_random(component, seed++);
}

NavierStokes started(const AxisEnds& ends, Inertia inertia, const BoundaryVelocity& boundary = stirring) {
  FluidParameters parameters;
  parameters.inertia = inertia;
  NavierStokes fluid(unequal(ends), parameters, boundary, WallMotion::unsteady);
  set_random_force(fluid, 12);
  return fluid;
}

// Of the roughest source there is, a new one in each step, with a mean, which no flow can have.
TEST(NavierStokesDivergence, IsTheGivenOneToRoundOff) {
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic})
    for (const Inertia inertia : all_inertias) {
      NavierStokes fluid = started(ends, inertia);
      EXPECT_EQ(fluid.given_divergence(), nullptr);
      for (int k = 0; k < 3; ++k) {
        Field<Cell>& source = fluid.divergence_source();
        test::fill_random(source.points(), 40 + k);
        source(1, 2, 3) += 100.0;
        const Field<Cell> before = source.clone();
        fluid.step(0.05);
        EXPECT_TRUE(test::same_bits(source, before)) << "it is kept";
        ASSERT_NE(fluid.given_divergence(), nullptr);
        const Field<Cell>& given = *fluid.given_divergence();
        EXPECT_NEAR(mean(given), 0.0, 1e-14);
        test::for_each_point(given.extent(), [&, whole = mean(source)](int i, int j, int l) {
          EXPECT_NEAR(given(i, j, l), source(i, j, l) - whole, 1e-13);
        });
        EXPECT_LT(max_divergence(fluid.velocity(), &given), 2e-12);  // of 100
        EXPECT_GT(max_divergence(fluid.velocity()), 99.0);
      }
      fluid.divergence_source().fill(0.0);
      fluid.step(0.05);
      EXPECT_LT(max_divergence(fluid.velocity()), 2e-12);
    }
}

// With every treatment of a viscosity that varies, too.
TEST(NavierStokesDivergence, IsTheGivenOneWithAFieldOfViscosity) {
  for (const ViscousTreatment treatment :
       {ViscousTreatment::explicit_, ViscousTreatment::extrapolated, ViscousTreatment::implicit}) {
    const Grid grid = unequal({});
    FluidParameters parameters;
    parameters.viscous_treatment = treatment;
    parameters.viscosity = sample_viscosity(grid, [](const Vector3& r) { return 1.5 + std::sin(2 * r[0] + r[1]); });
    NavierStokes fluid(grid, parameters, stirring, WallMotion::unsteady);
    set_random_force(fluid, 12);
    test::fill_random(fluid.divergence_source().points(), 40);
    for (int k = 0; k < 3; ++k) fluid.step(0.05);
    EXPECT_LT(max_divergence(fluid.velocity(), fluid.given_divergence()), 1e-12);
  }
}

// Nothing is added to a step that has no source, nor by one that is zero everywhere.
TEST(NavierStokesDivergence, ASourceOfZerosIsNone) {
  for (const AxisEnds& ends : {AxisEnds{}, all_periodic})
    for (const Inertia inertia : all_inertias) {
      NavierStokes without = started(ends, inertia), with = started(ends, inertia);
      with.divergence_source();
      for (int k = 0; k < 3; ++k)
        for (NavierStokes* fluid : {&without, &with}) fluid->step(0.05);
      EXPECT_EQ(without.given_divergence(), nullptr);
      EXPECT_TRUE(test::same_bits(without.velocity(), with.velocity()));
      EXPECT_TRUE(test::same_bits(without.pressure(), with.pressure()));
    }
}

// A steady flow, which the discrete one grows out of: its error is that of the differences in space. Where there is inertia
// the momentum of u div u belongs to it, half of it as convection() has it.
TEST(NavierStokesDivergence, AManufacturedFlowIsOfSecondOrderInSpace) {
  const auto errors = [](const AxisEnds& ends, Inertia inertia, double reynolds_number, int cells) {
    const FlowWithDivergence flow{reynolds_number};
    constexpr double t = 0.2;  // of the flow, which stands still
    const Grid grid({-1, -1, -1}, {1, 1, 1}, {cells, cells, cells}, ends);
    FluidParameters parameters;
    parameters.reynolds_number = reynolds_number;
    parameters.inertia = inertia;
    NavierStokes fluid(grid, parameters, [&](const Vector3& r, double) { return flow.velocity(r, t); });
    FaceVector now(grid);
    test::sample_faces(now, [&](const Vector3& r) { return flow.velocity(r, t); });
    const Field<Cell> p = test::sample_pressure(grid, [&](const Vector3& r) { return flow.pressure(r, t); });
    constexpr double dt = 0.05;
    fluid.restore(now, now, p, {0.0, -dt, dt, 1});
    test::sample_faces(fluid.force(), [&](const Vector3& r) {
      if (inertia == Inertia::none) return flow.stokes_force(r, t);
      Vector3 f = flow.force(r, t);
      const Vector3 before = flow.velocity(r, t - 1e-4), after = flow.velocity(r, t + 1e-4);
      for (std::size_t i = 0; i < 3; ++i) f[i] -= reynolds_number * (after[i] - before[i]) / 2e-4;
      return f;
    });
    fluid.divergence_source() = test::sample_pressure(grid, [&](const Vector3& r) { return flow.divergence(r, t); });
    for (int k = 0; k < 20; ++k) fluid.step(dt);
    return test::flow_errors(fluid.velocity(), fluid.pressure(), flow, t);
  };
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic})
    for (const auto& [inertia, reynolds_number] :
         {std::pair(Inertia::full, 1.0), std::pair(Inertia::full, 1e-3), std::pair(Inertia::none, 1.0)}) {
      const test::FlowErrors coarse = errors(ends, inertia, reynolds_number, 16);
      const test::FlowErrors fine = errors(ends, inertia, reynolds_number, 24);
      EXPECT_NEAR(test::slope(coarse.velocity_l2, 16, fine.velocity_l2, 24), 2.0, 0.15) << reynolds_number;
      EXPECT_GT(test::slope(coarse.pressure_l2, 16, fine.pressure_l2, 24), 1.5) << reynolds_number;
    }
}

struct State {
  FaceVector velocity;
  Field<Cell> pressure;
};

// From rest smoothly, driven by walls, a force and a source, on a fixed grid: differences between step sizes are errors of
// time alone.
State run_from_rest(const AxisEnds& ends, int steps) {
  const auto ramp = [](double t) { return std::pow(std::sin(0.5 * std::numbers::pi * t), 4); };
  const FlowWithDivergence flow;
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {9, 8, 10}, ends);
  NavierStokes fluid(
      grid, {},
      [&](const Vector3& r, double t) {
        Vector3 u = flow.velocity(r, t);
        for (double& component : u) component *= ramp(t);
        return u;
      },
      WallMotion::unsteady);
  const double dt = 1.0 / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = fluid.time() + dt;
    test::sample_faces(fluid.force(), [&](const Vector3& r) {
      Vector3 f = flow.stokes_force(r, t);
      for (double& component : f) component *= ramp(t);
      return f;
    });
    Field<Cell>& source = fluid.divergence_source();
    test::for_each_point(source.extent(), [&](int i, int j, int k) {
      source(i, j, k) = ramp(t) * flow.divergence(source.position(i, j, k), t);
    });
    fluid.step(dt);
  }
  return {fluid.velocity().clone(), fluid.pressure().clone()};
}

// The pressure takes p + phi - mu (div u* - source). With the divergence of u* alone, as without a source, that of the
// pressure would be wrong by mu div u, which no smaller step mends.
TEST(NavierStokesDivergence, IsOfSecondOrderInTime) {
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic}) {
    const auto difference = [](const State& a, const State& b) {
      double velocity = 0.0, pressure = 0.0;
      for (int c = 0; c < 3; ++c) {
        const ConstView x = a.velocity.unknowns()[c], y = b.velocity.unknowns()[c];
        test::for_each_point(x.extent, [&](int i, int j, int k) { velocity += std::pow(x(i, j, k) - y(i, j, k), 2); });
      }
      test::for_each_point(a.pressure.extent(), [&](int i, int j, int k) {
        pressure += std::pow(a.pressure(i, j, k) - b.pressure(i, j, k), 2);
      });
      return std::pair(std::sqrt(velocity), std::sqrt(pressure));
    };
    const State coarse = run_from_rest(ends, 128), middle = run_from_rest(ends, 256), fine = run_from_rest(ends, 512);
    const auto first = difference(coarse, middle), second = difference(middle, fine);
    std::printf("time order %g %g\n", std::log2(first.first / second.first), std::log2(first.second / second.second));
    EXPECT_NEAR(std::log2(first.first / second.first), 2.0, 0.1);
    EXPECT_GT(std::log2(first.second / second.second), 1.5);
  }
}

// The pressure is that of the steady state: of a flow that stands still it is exact, whatever the step.
TEST(NavierStokesDivergence, TheSteadyPressureDoesNotDependOnTheStep) {
  for (const AxisEnds& ends : {AxisEnds{}, all_periodic}) {
    const FlowWithDivergence flow;
    const Grid grid({-1, -1, -1}, {1, 1, 1}, {10, 11, 12}, ends);
    const auto walls = [&](const Vector3& r, double) { return flow.velocity(r, 0.2); };
    const auto solve = [&](Inertia inertia, double dt, int steps) {
      FluidParameters parameters;
      parameters.inertia = inertia;
      parameters.stokes.tolerance = 1e-11;
      NavierStokes fluid(grid, parameters, walls);
      test::sample_faces(fluid.force(), [&](const Vector3& r) { return flow.stokes_force(r, 0.2); });
      fluid.divergence_source() =
          test::sample_pressure(grid, [&](const Vector3& r) { return flow.divergence(r, 0.2); });
      for (int k = 0; k < steps; ++k) fluid.step(dt);
      return State{fluid.velocity().clone(), fluid.pressure().clone()};
    };
    const State stokes = solve(Inertia::none, 1.0, 1);
    for (const double dt : {0.1, 1.0}) {
      const State unsteady = solve(Inertia::unsteady, dt, 300);
      EXPECT_LT(test::max_difference(stokes.velocity, unsteady.velocity), 1e-8);
      EXPECT_LT(test::max_difference(stokes.pressure.points(), unsteady.pressure.points()), 1e-6);
    }
  }
}

// Of a state that no step has led to it is what the velocity has.
TEST(NavierStokesDivergence, BelongsToTheState) {
  NavierStokes fluid = started({}, Inertia::full), restored = started({}, Inertia::full);
  test::fill_random(fluid.divergence_source().points(), 40);
  EXPECT_EQ(test::max_abs(fluid.given_divergence()->points()), 0.0);
  fluid.step(0.05);
  fluid.remember();
  const Field<Cell> given = fluid.given_divergence()->clone();
  restored.divergence_source();
  restored.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
  EXPECT_LT(test::max_difference(restored.given_divergence()->points(), given.points()), 1e-12);
  test::fill_random(fluid.divergence_source().points(), 41);
  fluid.step(0.05);
  fluid.retry();
  EXPECT_LT(test::max_difference(fluid.given_divergence()->points(), given.points()), 1e-12);
  fluid.set_velocity([](const Vector3&) { return Vector3{}; });
  EXPECT_LT(test::max_abs(fluid.given_divergence()->points()), 1e-12);
  EXPECT_LT(max_divergence(fluid.velocity()), 1e-12);
}

TEST(NavierStokesDivergence, ARetriedStepTakesTheSourceThatItIsGiven) {
  for (const Inertia inertia : all_inertias) {
    NavierStokes straight = started({}, inertia), tried = started({}, inertia);
    for (int k = 0; k < 3; ++k) {
      tried.remember();
      test::fill_random(tried.divergence_source().points(), 99);
      tried.step(0.03);
      tried.retry();
      for (NavierStokes* fluid : {&straight, &tried}) {
        test::fill_random(fluid->divergence_source().points(), 40);
        fluid->step(0.05);
      }
      EXPECT_TRUE(test::same_bits(straight.velocity(), tried.velocity()));
      EXPECT_TRUE(test::same_bits(straight.pressure(), tried.pressure()));
    }
  }
}

TEST(NavierStokesDivergence, ARestoredRunContinuesBitForBit) {
  for (const Inertia inertia : all_inertias) {
    NavierStokes fluid = started({}, inertia), restored = started({}, inertia);
    test::fill_random(fluid.divergence_source().points(), 40);
    for (int k = 0; k < 3; ++k) fluid.step(0.05);
    restored.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
    for (NavierStokes* one : {&fluid, &restored}) {
      test::fill_random(one->divergence_source().points(), 41);
      for (int k = 0; k < 2; ++k) one->step(0.05);
    }
    EXPECT_TRUE(test::same_bits(fluid.velocity(), restored.velocity()));
    EXPECT_TRUE(test::same_bits(fluid.pressure(), restored.pressure()));
  }
}

TEST(NavierStokesDivergence, SameBitsForAnyNumberOfThreads) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {27, 28, 29});
  for (const Inertia inertia : all_inertias) {
    const auto run = [&](int threads) {
      const test::ThreadCount count(threads);
      FluidParameters parameters;
      parameters.inertia = inertia;
      NavierStokes fluid(grid, parameters, stirring, WallMotion::unsteady);
      fluid.keep_force();
      test::fill_random(fluid.divergence_source().points(), 40);
      for (int k = 0; k < 2; ++k) fluid.step(0.05);
      set_random_force(fluid, 12);
      fluid.solve_again();
      return fluid.velocity().clone();
    };
    EXPECT_TRUE(test::same_bits(run(1), run(3)));
  }
}

TEST(NavierStokesDivergence, StepsAllocateNothing) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const Inertia inertia : all_inertias) {
    NavierStokes fluid = started({}, inertia);
    fluid.keep_force();
    test::fill_random(fluid.divergence_source().points(), 40);
    for (int k = 0; k < 2; ++k) fluid.step(0.05);
    const long before = vesiflow::test::allocation_count();
    fluid.step(0.05);
    fluid.solve_again();
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
  }
}

TEST(NavierStokesDivergence, RefusesASourceThatCannotBe) {
  const Grid other({-1, 0, 0}, {1, 3, 1}, {11, 8, 12});
  for (const Inertia inertia : all_inertias) {
    NavierStokes fluid = started({}, inertia);
    fluid.divergence_source() = Field<Cell>(other);
    EXPECT_THAT([&] { fluid.step(0.05); },
                ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("source"), HasSubstr("another grid"))));
    EXPECT_EQ(fluid.steps(), 0);
    fluid.divergence_source() = Field<Cell>(fluid.grid());
    fluid.step(0.05);
    fluid.divergence_source()(1, 2, 3) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(fluid.step(0.05), std::runtime_error);
  }
}

// What a step with the last force, from the same state, would have led to; the guess is another one, so not to the last bit.
TEST(SolveAgain, GivesTheSolutionOfTheForceAndTheSourceAsTheyAreNow) {
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic})
    for (const bool is_field : {false, true}) {
      FluidParameters parameters;
      parameters.inertia = Inertia::none;
      parameters.stokes.tolerance = 1e-11;
      if (is_field)
        parameters.viscosity =
            sample_viscosity(unequal(ends), [](const Vector3& r) { return 2.0 + std::sin(3 * r[0]); });
      NavierStokes once(unequal(ends), parameters, stirring, WallMotion::unsteady);
      NavierStokes again(unequal(ends), parameters, stirring, WallMotion::unsteady);
      for (NavierStokes* fluid : {&once, &again}) {
        set_random_force(*fluid, 12);
        fluid->step(0.1);
      }
      const auto change = [](NavierStokes& fluid) {
        set_random_force(fluid, 77);
        fluid.uniform_force() = {0.1, 0.2, -0.3};
        test::fill_random(fluid.divergence_source().points(), 40);
      };
      again.step(0.07);  // with the old force
      EXPECT_LT(max_divergence(again.velocity()), 1e-12);
      const FaceVector before = again.previous_velocity().clone();
      change(again);
      again.solve_again();
      change(once);
      once.step(0.07);
      EXPECT_LT(test::max_difference(once.velocity(), again.velocity()), 1e-9) << is_field;
      EXPECT_LT(test::max_difference(once.pressure().points(), again.pressure().points()), 1e-7) << is_field;
      EXPECT_LT(max_divergence(again.velocity(), again.given_divergence()), 1e-12);
      // It is no step.
      EXPECT_EQ(again.steps(), 2);
      EXPECT_EQ(again.time(), once.time());
      EXPECT_TRUE(test::same_bits(again.previous_velocity(), before));
      EXPECT_TRUE(test::same_bits(again.previous_velocity(), once.previous_velocity()));
      EXPECT_GT(again.report().stokes.iterations, 0);
    }
}

TEST(SolveAgain, OfTheSameForceChangesNothing) {
  FluidParameters parameters;
  parameters.inertia = Inertia::none;
  NavierStokes fluid(unequal({}), parameters, stirring, WallMotion::unsteady);
  set_random_force(fluid, 12);
  for (int k = 0; k < 2; ++k) fluid.step(0.1);
  const FaceVector before = fluid.velocity().clone();
  const int iterations = fluid.report().stokes.iterations;
  for (int k = 0; k < 2; ++k) {
    fluid.solve_again();
    EXPECT_LT(test::max_difference(before, fluid.velocity()), 1e-6);  // the tolerance is 1e-8 of other norms
    EXPECT_LT(fluid.report().stokes.iterations, iterations / 4 + 1);
  }
}

// It goes on from the solution that was found last.
TEST(SolveAgain, TheNextStepIsThatOfTheLastSolution) {
  NavierStokes again = started({}, Inertia::none), restored = started({}, Inertia::none);
  again.step(0.1);
  set_random_force(again, 77);
  again.solve_again();
  restored.restore(again.velocity(), again.previous_velocity(), again.pressure(), again.clock());
  for (NavierStokes* fluid : {&again, &restored}) {
    set_random_force(*fluid, 78);
    fluid->step(0.1);
    fluid->solve_again();
  }
  EXPECT_TRUE(test::same_bits(again.velocity(), restored.velocity()));
}

// With inertia: from the state that the step began with, and so to round-off. Walls move, and the step before is of another length.
TEST(SolveAgain, GivesWithInertiaWhatTheStepWithTheForceOfNowGives) {
  constexpr AxisEnds half{.periodic = {false, true, false}, .mirror = {true, false, false}};
  const auto sliding = [](const Vector3& r, double t) { return Vector3{0.0, std::sin(r[0] + t), 0.0}; };
  for (const AxisEnds& ends : {AxisEnds{}, channel, all_periodic, half})
    for (const Inertia inertia : {Inertia::full, Inertia::unsteady}) {
      const BoundaryVelocity boundary = ends.mirror[0] ? BoundaryVelocity(sliding) : stirring;
      NavierStokes once = started(ends, inertia, boundary), again = started(ends, inertia, boundary);
      again.keep_force();
      const auto change = [](NavierStokes& fluid, unsigned seed) {
        set_random_force(fluid, seed);
        fluid.uniform_force() = {0.1 * seed, 0.2, -0.3};
        test::fill_random(fluid.divergence_source().points(), seed + 1);
      };
      for (NavierStokes* fluid : {&once, &again}) {
        change(*fluid, 12);
        fluid->step(0.1);
      }
      change(again, 55);
      again.step(0.07);
      for (const unsigned seed : {66, 77}) {
        change(again, seed);
        again.solve_again();
      }
      change(once, 77);
      once.step(0.07);
      const auto compare = [&] {
        EXPECT_LT(test::max_difference(once.velocity(), again.velocity()), 1e-12);
        EXPECT_LT(test::max_difference(once.pressure().points(), again.pressure().points()), 1e-10);
        EXPECT_LT(max_divergence(again.velocity(), again.given_divergence()), 1e-11);
        EXPECT_EQ(again.steps(), once.steps());
        EXPECT_EQ(again.time(), once.time());
      };
      compare();
      EXPECT_TRUE(test::same_bits(again.previous_velocity(), once.previous_velocity()));
      for (NavierStokes* fluid : {&once, &again}) fluid->step(0.07);  // ghosts and convection of before are right, too
      compare();
    }
}

TEST(SolveAgain, IsRefusedWhereNoStepOfThisStateHasKeptItsForce) {
  for (const Inertia inertia : {Inertia::full, Inertia::unsteady}) {
    NavierStokes fluid = started({}, inertia);
    fluid.step(0.1);
    EXPECT_THROW(fluid.solve_again(), std::logic_error);
    fluid.keep_force();
    EXPECT_THROW(fluid.solve_again(), std::logic_error);
    fluid.step(0.1);
    EXPECT_NO_THROW(fluid.solve_again());
    const FaceVector velocity = fluid.velocity().clone(), previous = fluid.previous_velocity().clone();
    const Field<Cell> pressure = fluid.pressure().clone();
    fluid.restore(velocity, previous, pressure, FluidClock(fluid.clock()));
    EXPECT_THROW(fluid.solve_again(), std::logic_error);
  }
  NavierStokes fluid = started({}, Inertia::none);
  EXPECT_THROW(fluid.solve_again(), std::logic_error);
  fluid.step(0.1);
  EXPECT_NO_THROW(fluid.solve_again());
  fluid.set_velocity([](const Vector3&) { return Vector3{}; });
  EXPECT_THROW(fluid.solve_again(), std::logic_error);
}

TEST(SolveAgain, IsRefusedWithInertiaAndAFieldOfViscosity) {
  FluidParameters parameters;
  parameters.viscosity = sample_viscosity(unequal({}), [](const Vector3& r) { return 2.0 + std::sin(3 * r[0]); });
  NavierStokes fluid(unequal({}), parameters, stirring, WallMotion::unsteady);
  fluid.keep_force();
  fluid.step(0.01);
  EXPECT_THROW(fluid.solve_again(), std::logic_error);
}

TEST(SolveAgain, SaysInWhichStepItFailed) {
  NavierStokes fluid = started({}, Inertia::none);
  fluid.step(0.1);
  fluid.force().x.fill(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT([&] { fluid.solve_again(); }, ThrowsMessage<std::runtime_error>(HasSubstr("step 1 to time 0.1")));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_divergence_test
