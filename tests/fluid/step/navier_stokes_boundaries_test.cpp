// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The time step with periodic axes, walls, and mixtures of both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "fluid/operators.h"
#include "manufactured_flow.h"
#include "test_problems.h"

namespace vesiflow::fluid::navier_stokes_boundaries_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Even, odd, prime and unequal.
const Grid grids[] = {Grid({-1, -1, -1}, {1, 1, 1}, {16, 12, 16}), Grid({0, -1, 0}, {1, 2, 5}, {7, 11, 13}),
                      Grid({-3, 0, 0}, {1, 1, 1}, {23, 9, 4})};

Vector3 no_slip(const Vector3&, double) {
  return {};
}

TEST(NavierStokes, ProjectsARandomVelocityToRoundOffWithEveryMixOfBoundaries) {
  for (const Grid& box : grids) {
    for (unsigned mask = 0; mask < 8; ++mask) {
      const Grid grid = test::with_periodic_axes(box, mask);
      NavierStokes fluid(grid, {}, no_slip);
      std::mt19937 generator(7);
      std::uniform_real_distribution<double> uniform(-1.0, 1.0);
      fluid.set_velocity([&](const Vector3&) {
        return Vector3{uniform(generator), uniform(generator), uniform(generator)};
      });
      EXPECT_GT(test::dot(fluid.velocity(), fluid.velocity()), 1.0);
      EXPECT_LT(max_divergence(fluid.velocity()) * grid.min_spacing(), 1e-14) << mask;
      unsigned seed = 9;
      for (const View& component : fluid.force().unknowns()) test::fill_random(component, seed++);
      for (int k = 0; k < 3; ++k) fluid.step(0.05);
      EXPECT_LT(max_divergence(fluid.velocity()) * grid.min_spacing(), 1e-14) << mask;
    }
  }
}

TEST(NavierStokes, PreservesShearFlowBetweenTwoWalls) {
  const Grid grid({0, -1, 0}, {1, 2, 5}, {7, 11, 13}, {.periodic = {true, true, false}});
  const auto shear = [](const Vector3& r, double) { return Vector3{r[2], 0.0, 0.0}; };
  NavierStokes fluid(grid, {}, shear);
  fluid.set_velocity([&](const Vector3& r) { return shear(r, 0.0); });
  const FaceVector start = fluid.velocity().clone();
  for (int k = 0; k < 20; ++k) fluid.step(0.01);
  EXPECT_LT(test::max_difference(fluid.velocity(), start), 1e-13);
}

// Two cells of the decaying vortex u = (sin ax cos by, -a/b cos ax sin by, 0) exp(-(a^2 + b^2) t / Re).
struct TaylorGreen {
  double a, b, reynolds_number;
  Vector3 velocity(const Vector3& r, double t) const {
    const double decay = std::exp(-(a * a + b * b) * t / reynolds_number);
    return {std::sin(a * r[0]) * std::cos(b * r[1]) * decay, -a / b * std::cos(a * r[0]) * std::sin(b * r[1]) * decay,
            0.0};
  }
  double pressure(const Vector3& r, double t) const {
    const double decay = std::exp(-2 * (a * a + b * b) * t / reynolds_number);
    return 0.25 * reynolds_number * (std::cos(2 * a * r[0]) + a * a / (b * b) * std::cos(2 * b * r[1])) * decay;
  }
};

TEST(NavierStokes, ConvergesToTheTaylorGreenVortexInAPeriodicBox) {
  const auto errors = [](int n) {
    const Grid grid({0, 0, 0}, {2, 1, 1}, {n, n + n / 4, 4}, {.periodic = {true, true, true}});
    const TaylorGreen flow{std::numbers::pi, 2 * std::numbers::pi, 10.0};
    FluidParameters parameters;
    parameters.reynolds_number = flow.reynolds_number;
    NavierStokes fluid(grid, parameters);
    fluid.set_velocity([&](const Vector3& r) { return flow.velocity(r, 0.0); });
    for (int k = 0; k < 80; ++k) fluid.step(0.0005);  // the first, of first order, leaves an error of 1 %
    return test::flow_errors(fluid.velocity(), fluid.pressure(), flow, fluid.time());
  };
  const auto coarse = errors(24);
  const auto fine = errors(48);
  EXPECT_NEAR(std::log2(coarse.velocity_l2 / fine.velocity_l2), 2.0, 0.1);
  EXPECT_NEAR(std::log2(coarse.pressure_l2 / fine.pressure_l2), 2.0, 0.15);
}

// A uniform force in a periodic box only accelerates: Re du/dt = f.
TEST(NavierStokes, AcceleratesAPeriodicBoxAsAWhole) {
  const Grid grid({0, 0, 0}, {1, 2, 3}, {5, 6, 7}, {.periodic = {true, true, true}});
  FluidParameters parameters;
  parameters.reynolds_number = 2.0;
  NavierStokes fluid(grid, parameters);
  fluid.force().y.fill(3.0);
  for (int k = 0; k < 10; ++k) fluid.step(0.05);
  test::for_each_point(fluid.velocity().y.unknowns().extent,
                       [&](int i, int j, int k) { EXPECT_NEAR(fluid.velocity().y(i, j, k), 0.75, 1e-13); });
  EXPECT_LT(test::max_abs(fluid.velocity().x.points()), 1e-13);
}

// A uniform force is a field of force that is the same everywhere, whatever the inertia.
TEST(NavierStokes, TakesAUniformForceAsAFieldOfIt) {
  const Grid grid({0, 0, 0}, {1, 2, 3}, {6, 7, 8}, {.periodic = {true, false, false}});
  for (const Inertia inertia : {Inertia::full, Inertia::none}) {
    FluidParameters parameters;
    parameters.inertia = inertia;
    parameters.stokes.tolerance = 1e-12;
    NavierStokes filled(grid, parameters, no_slip), uniform(grid, parameters, no_slip);
    filled.force().x.fill(3.0);
    filled.force().z.fill(-1.0);
    uniform.uniform_force() = {1.0, 0.0, -1.0};
    uniform.force().x.fill(2.0);
    for (int k = 0; k < 3; ++k) {
      filled.step(0.05);
      uniform.step(0.05);
    }
    EXPECT_GT(test::max_abs(filled.velocity().x.points()), 0.1);
    EXPECT_LT(test::max_difference(filled.velocity(), uniform.velocity()), 1e-12);
    EXPECT_LT(test::max_difference(filled.pressure().points(), uniform.pressure().points()), 1e-10);
  }
}

// What happens does not depend on where a periodic box is cut: the force moved by one cell moves the flow.
TEST(NavierStokes, FollowsATranslationAlongAPeriodicAxis) {
  const Grid grid({0, 0, 0}, {1, 2, 3}, {6, 7, 8}, {.periodic = {true, false, true}});
  const auto run = [&](int shift) {
    NavierStokes fluid(grid, {}, no_slip);
    const auto f = fluid.force().unknowns();
    for (int c = 0; c < 3; ++c) {
      test::for_each_point(f[c].extent, [&](int i, int j, int k) {
        f[c]((i + shift) % 6, j, k) = std::sin(1.0 + 3.1 * i + 0.7 * j * j + 1.3 * k * (c + 1));
      });
    }
    for (int k = 0; k < 4; ++k) fluid.step(0.05);
    return fluid.velocity().clone();
  };
  const FaceVector here = run(0);
  const FaceVector moved = run(1);
  for (int c = 0; c < 3; ++c) {
    const ConstView u = here.unknowns()[c];
    const ConstView v = moved.unknowns()[c];
    test::for_each_point(u.extent, [&](int i, int j, int k) { EXPECT_NEAR(v((i + 1) % 6, j, k), u(i, j, k), 1e-13); });
  }
}

TEST(WallVelocity, RefusesAFunctionThatDiffersAtTheEndsOfAPeriodicAxis) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {false, false, true}});
  EXPECT_THAT(([&] { NavierStokes(grid, {}, [](const Vector3& r, double) {
                       return Vector3{r[2], 0.0, 0.0};
                     }); }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("periodic axis 2")));
  EXPECT_THAT([&] { NavierStokes(grid, {}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("empty function")));
}

// Round-off is that of the greatest velocity, whatever its unit: a small component may differ by that much, and by no more.
TEST(WallVelocity, AllowsRoundOffOfFastWallsAtTheEndsOfAPeriodicAxis) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {false, false, true}});
  const auto walls = [&](double difference) {
    return WallVelocity(grid, [=](const Vector3& r, double) {
      return Vector3{r[2] > 0.5 ? difference : 0.0, 1e9, 0.0};
    });
  };
  EXPECT_NO_THROW(walls(1e-3));
  EXPECT_THROW(walls(1.0), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_boundaries_test
