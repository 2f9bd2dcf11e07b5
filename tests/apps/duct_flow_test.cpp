// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "duct_flow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

SteadyOptions quiet(double tolerance) {
  SteadyOptions options;
  options.tolerance = tolerance;
  options.progress = false;
  return options;
}

double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

// Errors are c h^2 (1 + O(h)): next to the walls, where the maximum is, the order comes up to 2 from below.
TEST(DuctFlow, ConvergesWithOrderTwoInPeriodicDucts) {
  for (const double e : {3.0, 2.25}) {
    const Duct duct{.d = 3, .e = e, .length = 6, .reynolds_number = 1};
    const auto flow = [&](int cells) {
      return compute_duct(duct, {4, cells, static_cast<int>(cells * e / 3)}, DuctMethod::unsteady, quiet(1e-11));
    };
    const DuctFlow coarse = flow(32), fine = flow(64);
    EXPECT_TRUE(coarse.run.steady && fine.run.steady);
    EXPECT_NEAR(order(coarse.error_l2, fine.error_l2), 2, 0.01);
    EXPECT_NEAR(order(coarse.error_max, fine.error_max), 2, 0.03);
    EXPECT_LT(fine.cross_flow, 1e-14);
  }
}

// The error of the scheme in closed form. Second differences are exact for the parabola of a plane channel; the wall halfway
// between a point and its mirror image is not: the discrete flow is 1 - z^2/e^2 + h^2 / (4 e^2), with an error of G h^2 / 8
// everywhere, where G is the pressure gradient. In a duct that is the error next to the walls, and the largest, to O(h).
TEST(DuctFlow, HasTheErrorOfTheWallsThatLieHalfwayBetweenPoints) {
  for (const double e : {3.0, 2.25}) {
    const Duct duct{.d = 3, .e = e, .length = 6, .reynolds_number = 1};
    const auto relative = [&](int cells) {
      const double h = 6.0 / cells;
      return compute_duct(duct, {4, cells, static_cast<int>(cells * e / 3)}, DuctMethod::unsteady, quiet(1e-11))
                 .error_max /
             (vesiflow::fluid::DuctSeries(3, e).pressure_gradient() * h * h / 8);
    };
    const double coarse = 1 - relative(32), fine = 1 - relative(64);
    EXPECT_NEAR(fine, 0, 0.02);
    EXPECT_NEAR(coarse / fine, 2, 0.2);
  }
}

// With ends that are told the series, the pressure has to take over the driving.
TEST(DuctFlow, ConvergesWithOrderTwoBetweenWalls) {
  const auto check = [](double e, double reynolds_number, DuctMethod method) {
    const Duct duct{.d = 3, .e = e, .length = 6, .ends = DuctEnds::walls, .reynolds_number = reynolds_number};
    const auto flow = [&](int cells) {
      return compute_duct(duct, {cells, cells, static_cast<int>(cells * e / 3)}, method, quiet(1e-8));
    };
    const DuctFlow coarse = flow(16), fine = flow(32);
    EXPECT_TRUE(coarse.run.steady && fine.run.steady);
    EXPECT_NEAR(order(coarse.error_l2, fine.error_l2), 2, 0.1);
    EXPECT_NEAR(order(coarse.cross_flow, fine.cross_flow), 2, 0.3);
  };
  check(3, 1, DuctMethod::stokes);
  check(2.25, 1, DuctMethod::stokes);
  check(2.25, 1, DuctMethod::unsteady);
}

TEST(DuctFlow, ErrorDoesNotDependOnTheTimeStep) {
  const Duct duct{.d = 3, .e = 3, .length = 6, .reynolds_number = 0.1};
  SteadyOptions options = quiet(1e-12);
  const double usual = compute_duct(duct, {4, 16, 16}, DuctMethod::unsteady, options).error_max;
  options.time_step = duct.diffusion_time() / 4;
  EXPECT_NEAR(compute_duct(duct, {4, 16, 16}, DuctMethod::unsteady, options).error_max, usual, 1e-11);
}

// Without inertia both reach the same discrete flow; the unsteady one within change * decay time of a few T.
TEST(DuctFlow, StokesSolverFindsTheSteadyStateOfTheUnsteadyEquations) {
  const Duct duct{.d = 3, .e = 3, .length = 6, .ends = DuctEnds::walls, .reynolds_number = 1e-3};
  const DuctFlow stokes = compute_duct(duct, {12, 12, 12}, DuctMethod::stokes, quiet(1e-11));
  const DuctFlow unsteady = compute_duct(duct, {12, 12, 12}, DuctMethod::unsteady, quiet(1e-10));
  EXPECT_TRUE(stokes.run.steady && unsteady.run.steady);
  EXPECT_LT(max_difference(stokes.velocity, unsteady.velocity), 1e-3 * stokes.error_max);
}

}  // namespace
