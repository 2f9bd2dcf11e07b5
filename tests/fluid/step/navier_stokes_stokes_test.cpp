// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The time step without inertia: every step is a Stokes problem.
#include <gtest/gtest.h>

#include "fluid/operators.h"
#include "manufactured_flow.h"
#include "support/allocation_counter.h"
#include "test_problems.h"
#include "thread_count.h"

namespace vesiflow::fluid::navier_stokes_stokes_test {
namespace {

// Of the unsteady equations at rest in time, and of Stokes flow, the solution is the same.
TEST(WithoutInertia, AStepIsTheSteadyStateOfTheUnsteadyStokesEquations) {
  for (const unsigned mask : {0u, 2u}) {
    for (const double ratio : {1.0, 5.0}) {
      const Grid grid = test::with_periodic_axes(Grid({-1, -1, -1}, {1, 1, 1}, {10, 9, 11}), static_cast<int>(mask));
      FluidParameters parameters;
      parameters.viscous_treatment = ViscousTreatment::implicit;
      parameters.viscosity =
          sample_viscosity(grid, [&](const Vector3& r) { return 1.0 + (ratio - 1.0) * std::exp(-4 * r[0] * r[0]); });
      const auto walls = [](const Vector3& r, double) { return Vector3{std::sin(r[2]), 0.3 * std::cos(r[0]), 0.0}; };
      const auto solve = [&](Inertia inertia, int steps) {
        parameters.inertia = inertia;
        parameters.stokes.tolerance = 1e-11;
        NavierStokes fluid(grid, parameters, walls);
        test::sample_faces(fluid.force(), [](const Vector3& r) {
          return Vector3{std::sin(2 * r[2]), std::cos(3 * r[2]), r[0] * r[2]};
        });
        for (int k = 0; k < steps; ++k) fluid.step(1.0);
        return std::pair(fluid.velocity().clone(), fluid.pressure().clone());
      };
      const auto [u, p] = solve(Inertia::none, 1);
      const auto [v, q] = solve(Inertia::unsteady, 300);
      EXPECT_LT(test::max_difference(u, v), 1e-8) << ratio;
      EXPECT_LT(test::max_difference(p.points(), q.points()), 1e-6) << ratio;
      EXPECT_LT(max_divergence(u) * grid.min_spacing(), 1e-13);
    }
  }
}

TEST(WithoutInertia, FollowsWallsAndForcesWithoutMemory) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 9, 10});
  FluidParameters parameters;
  parameters.inertia = Inertia::none;
  const auto walls = [](const Vector3& r, double t) { return Vector3{r[2] * std::cos(t), 0.0, 0.0}; };
  NavierStokes fluid(grid, parameters, walls, WallMotion::unsteady);
  for (int k = 0; k < 3; ++k) fluid.step(0.4);
  fluid.step(1.1);
  test::for_each_point(fluid.velocity().x.extent(), [&](int i, int j, int k) {
    EXPECT_NEAR(fluid.velocity().x(i, j, k), fluid.velocity().x.position(i, j, k)[2] * std::cos(2.3), 1e-8);
  });
  EXPECT_EQ(fluid.velocity_solver_name(), "stokes");
}

TEST(WithoutInertia, RestoredRunContinuesBitForBitAndStepsAllocateNothing) {
  const test::ThreadCount two(2);  // with one the OpenMP library itself allocates a team for every loop
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 9, 10});
  FluidParameters parameters;
  parameters.inertia = Inertia::none;
  for (const bool variable : {false, true}) {
    if (variable)
      parameters.viscosity = sample_viscosity(grid, [](const Vector3& r) { return 2.0 + std::sin(3 * r[0]); });
    const auto walls = [](const Vector3& r, double t) { return Vector3{std::sin(r[2] + t), 0.0, 0.0}; };
    NavierStokes fluid(grid, parameters, walls, WallMotion::unsteady);
    for (int k = 0; k < 3; ++k) fluid.step(0.1);
    NavierStokes restored(grid, parameters, walls, WallMotion::unsteady);
    restored.restore(fluid.velocity(), fluid.previous_velocity(), fluid.pressure(), fluid.clock());
    const long before = vesiflow::test::allocation_count();
    for (int k = 0; k < 2; ++k) fluid.step(0.1);
    EXPECT_EQ(vesiflow::test::allocation_count(), before);  // zero if malloc cannot be counted here
    for (int k = 0; k < 2; ++k) restored.step(0.1);
    EXPECT_TRUE(test::same_bits(fluid.velocity(), restored.velocity()));
    EXPECT_EQ(test::max_difference(fluid.pressure().points(), restored.pressure().points()), 0.0);
  }
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_stokes_test
