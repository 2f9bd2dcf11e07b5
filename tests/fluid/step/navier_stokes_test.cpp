// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Identities of the time step: divergence, exact flows, bits, errors.
#include "fluid/navier_stokes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "fluid/operators.h"
#include "test_fields.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::array<Grid, 3> grids{Grid({-1, -1, -1}, {1, 1, 1}, {16, 16, 16}), Grid({0, -1, 0}, {1, 2, 5}, {7, 11, 13}),
                                Grid({-3, 0, 0}, {1, 1, 1}, {23, 9, 4})};

Vector3 no_slip(const Vector3&, double) {
  return {};
}

Vector3 shear(const Vector3& r, double) {
  return {r[2], 0.0, 0.0};
}

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

TEST(NavierStokes, ProjectsARandomVelocityToRoundOff) {
  for (const Grid& grid : grids) {
    NavierStokes fluid(grid, {}, no_slip);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    fluid.set_velocity([&](const Vector3&) {
      return Vector3{uniform(generator), uniform(generator), uniform(generator)};
    });
    EXPECT_GT(test::dot(fluid.velocity(), fluid.velocity()), 1.0);
    EXPECT_LT(max_divergence(fluid.velocity()) * grid.min_spacing(), 1e-14);
    set_random_force(fluid, 9);
    for (int k = 0; k < 3; ++k) fluid.step(0.05);
    EXPECT_LT(max_divergence(fluid.velocity()) * grid.min_spacing(), 1e-14);
  }
}

TEST(NavierStokes, KeepsASolenoidalStartAsItIs) {
  const Grid& grid = grids[1];
  NavierStokes fluid(grid, {}, shear);
  fluid.set_velocity([](const Vector3& r) { return shear(r, 0.0); });
  test::for_each_point(fluid.velocity().x.extent(), [&](int i, int j, int k) {
    EXPECT_EQ(fluid.velocity().x(i, j, k), fluid.velocity().x.position(i, j, k)[2]);
  });
  EXPECT_TRUE(test::same_bits(fluid.velocity(), fluid.previous_velocity()));
}

// u = (z, 0, 0) with zero pressure solves the equations and their discretisation.
TEST(NavierStokes, PreservesShearFlowToRoundOff) {
  for (const double reynolds_number : {1e-3, 1.0, 100.0}) {
    for (const Grid& grid : grids) {
      FluidParameters parameters;
      parameters.reynolds_number = reynolds_number;
      NavierStokes fluid(grid, parameters, shear);
      fluid.set_velocity([](const Vector3& r) { return shear(r, 0.0); });
      const FaceVector start = fluid.velocity().clone();
      for (int k = 0; k < 20; ++k) fluid.step(0.01);
      EXPECT_LT(test::max_difference(fluid.velocity(), start), 1e-13);
      // Every step adds the round-off of the velocity's inertia Re u / dt and viscous term u / h, times lengths of
      // order one.
      const double epsilon = std::numeric_limits<double>::epsilon();
      const double bound = 20 * epsilon * (reynolds_number / 0.01 + 10 / grid.min_spacing());
      EXPECT_LT(test::max_abs(fluid.pressure().points()), bound);
    }
  }
}

// A gradient force is balanced by the pressure alone: p = chi after the first steps, and nothing moves.
TEST(NavierStokes, BalancesAGradientForceByPressure) {
  const Grid& grid = grids[1];
  NavierStokes fluid(grid, {}, no_slip);
  Field<Cell> potential(grid);
  test::fill_random(potential.points(), 4);
  double sum = 0.0;
  test::for_each_point(potential.extent(), [&](int i, int j, int k) { sum += potential(i, j, k); });
  const double mean = sum / static_cast<double>(grid.cell_count());
  test::for_each_point(potential.extent(), [&](int i, int j, int k) { potential(i, j, k) -= mean; });
  gradient(potential, fluid.force());
  for (int k = 0; k < 400; ++k) fluid.step(0.1);
  EXPECT_LT(test::max_difference(fluid.pressure().points(), potential.points()), 1e-10);
  EXPECT_LT(test::max_abs(fluid.velocity().x.points()), 1e-12);
}

TEST(NavierStokes, VelocityOnTheWallsIsTheDataAtTheTimeOfTheVelocity) {
  const Grid& grid = grids[1];
  NavierStokes fluid(grid, {}, stirring, WallMotion::unsteady);
  fluid.step(0.1);
  fluid.step(0.2);
  EXPECT_DOUBLE_EQ(fluid.time(), 0.1 + 0.2);
  const Field<FaceX>& u = fluid.velocity().x;
  EXPECT_NEAR(u(0, 3, 4), stirring(u.position(0, 3, 4), fluid.time())[0], 1e-13);
  Vector3 wall = u.position(3, 5, 0);
  wall[2] = grid.lower[2];
  EXPECT_NEAR(0.5 * (u(3, 5, 0) + u(3, 5, -1)), stirring(wall, fluid.time())[0], 1e-13);
}

TEST(NavierStokes, StokesFlowIsLinearInTheForce) {
  FluidParameters parameters;
  parameters.inertia = Inertia::unsteady;
  NavierStokes one(grids[1], parameters, no_slip);
  NavierStokes two(grids[1], parameters, no_slip);
  set_random_force(one, 3);
  set_random_force(two, 3);
  for (const View& f : two.force().unknowns()) {
    test::for_each_point(f.extent, [&](int i, int j, int k) { f(i, j, k) *= 2.0; });
  }
  for (int k = 0; k < 5; ++k) one.step(0.1);
  for (int k = 0; k < 5; ++k) two.step(0.1);
  const auto u = one.velocity().unknowns();
  const auto v = two.velocity().unknowns();
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(u[c].extent, [&](int i, int j, int k) { EXPECT_EQ(2.0 * u[c](i, j, k), v[c](i, j, k)); });
  }
}

TEST(NavierStokes, GivesTheSameBitsForEveryNumberOfThreads) {
  const auto run = [](int threads) {
    const test::ThreadCount count(threads);
    const Grid large({0, -1, 0}, {1, 2, 5}, {27, 26, 29});  // small ones are left to one thread
    NavierStokes fluid(large, {}, stirring, WallMotion::unsteady);
    fluid.set_velocity(swirl);
    set_random_force(fluid, 12);
    for (int k = 0; k < 4; ++k) fluid.step(0.02);
    return fluid;
  };
  const NavierStokes one = run(1);
  for (const int threads : {2, 3, 8}) {
    const NavierStokes many = run(threads);
    EXPECT_TRUE(test::same_bits(one.velocity(), many.velocity())) << threads;
    EXPECT_EQ(test::max_difference(one.pressure().points(), many.pressure().points()), 0.0) << threads;
  }
}

TEST(NavierStokes, RestoredRunContinuesBitForBit) {
  const auto advance = [](NavierStokes& fluid, int steps) {
    for (int k = 0; k < steps; ++k) {
      set_random_force(fluid, static_cast<unsigned>(fluid.steps()));
      fluid.step(fluid.steps() % 3 == 0 ? 0.03 : 0.02);
    }
  };
  for (const int steps_before : {0, 1, 5}) {
    NavierStokes fluid(grids[1], {}, stirring, WallMotion::unsteady);
    fluid.set_velocity(swirl);
    advance(fluid, steps_before);
    NavierStokes restored(grids[1], {}, stirring, WallMotion::unsteady);
    // Walls and ghosts need not be stored.
    FaceVector velocity = fluid.velocity().clone();
    velocity.y(2, -1, 3) = 77.0;
    velocity.x(0, 2, 3) = 77.0;
    restored.restore(velocity, fluid.previous_velocity(), fluid.pressure(), fluid.clock());
    advance(fluid, 4);
    advance(restored, 4);
    EXPECT_EQ(restored.steps(), steps_before + 4);
    EXPECT_EQ(restored.time(), fluid.time());
    EXPECT_TRUE(test::same_bits(fluid.velocity(), restored.velocity()));
    EXPECT_TRUE(test::same_bits(fluid.previous_velocity(), restored.previous_velocity()));
    EXPECT_EQ(test::max_difference(fluid.pressure().points(), restored.pressure().points()), 0.0);
  }
}

#ifdef VESIFLOW_WITH_CHOLMOD
TEST(NavierStokes, SolversOfEitherKindGiveTheSameFlow) {
  FluidParameters parameters;
  NavierStokes fft(grids[1], parameters, stirring, WallMotion::unsteady);
  parameters.pressure_solver = CholmodOptions{};
  parameters.velocity_solver = CholmodOptions{};
  NavierStokes cholmod(grids[1], parameters, stirring, WallMotion::unsteady);
  for (NavierStokes* fluid : {&fft, &cholmod}) {
    fluid->set_velocity(swirl);
    for (int k = 0; k < 3; ++k) fluid->step(0.05);
  }
  EXPECT_LT(test::max_difference(fft.velocity(), cholmod.velocity()), 1e-12);
}
#endif

TEST(NavierStokes, MemoryEstimateIsAFewDozenNumbersPerCellAndLessWithoutConvection) {
  FluidParameters parameters;
  const Grid grid({0, 0, 0}, {1, 1, 1}, {128, 128, 128});
  const auto full = static_cast<double>(NavierStokes::estimate_memory(grid, parameters));
  parameters.inertia = Inertia::unsteady;
  const auto stokes = static_cast<double>(NavierStokes::estimate_memory(grid, parameters));
  const double field = 8.0 * static_cast<double>(grid.cell_count());
  EXPECT_NEAR(full / field, 14.0, 1.5);
  EXPECT_NEAR((full - stokes) / field, 3.0, 0.2);
  // Measured with mallinfo2 at 64^3: 33.9, 73.3, 82.7 and 131.9 MB; estimated 32.9, 73.1, 82.0 and 131.0.
  const Grid cube({-1, -1, -1}, {1, 1, 1}, {64, 64, 64});
  const auto megabytes = [&] { return 1e-6 * static_cast<double>(NavierStokes::estimate_memory(cube, parameters)); };
  parameters = {};
  const test::ThreadCount one(1);
  EXPECT_NEAR(megabytes(), 33.9, 2.0);
  parameters.inertia = Inertia::none;
  EXPECT_NEAR(megabytes(), 73.3, 4.0);
  parameters.viscosity = sample_viscosity(cube, [](const Vector3& r) { return 2.0 + r[0]; });
  EXPECT_NEAR(megabytes(), 131.9, 7.0);
  parameters.inertia = Inertia::full;
  parameters.viscous_treatment = ViscousTreatment::implicit;
  EXPECT_NEAR(megabytes(), 82.7, 4.0);
}

TEST(NavierStokes, RefusesParametersOutOfRangeByName) {
  FluidParameters parameters;
  parameters.reynolds_number = -1.0;
  EXPECT_THAT([&] { NavierStokes(grids[0], parameters, no_slip); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("reynolds_number is -1")));
  parameters = {};
  parameters.viscosity = 0.0;
  EXPECT_THAT([&] { NavierStokes(grids[0], parameters, no_slip); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("viscosity is 0")));
  NavierStokes fluid(grids[0], {}, no_slip);
  EXPECT_THAT([&] { fluid.step(-0.1); }, ThrowsMessage<std::invalid_argument>(HasSubstr("time step is -0.1")));
}

TEST(NavierStokes, RefusesAStateThatDoesNotFit) {
  NavierStokes fluid(grids[0], {}, no_slip);
  const NavierStokes other(grids[1], {}, no_slip);
  EXPECT_THAT([&] { fluid.restore(other.velocity(), other.previous_velocity(), other.pressure(), other.clock()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("another grid")));
  const NavierStokes same(grids[0], {}, no_slip);
  EXPECT_THAT(
      [&] {
        fluid.restore(same.velocity(), same.velocity(), same.pressure(), {0.5, 0.0, 0.0, 3});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("step number 3")));
}

TEST(NavierStokes, StopsWithTheStepAndTheTimeWhenAForceIsNotFinite) {
  NavierStokes fluid(grids[1], {}, no_slip);
  fluid.step(0.25);
  fluid.force().y(3, 4, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { fluid.step(0.25); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("step 2"), HasSubstr("time 0.5"))));
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_test
