// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cavity_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fluid/navier_stokes.h"

using namespace cavity;
using vesiflow::fluid::FaceVector;
using vesiflow::fluid::FluidParameters;
using vesiflow::fluid::Grid;
using vesiflow::fluid::NavierStokes;
using vesiflow::fluid::Vector3;

namespace {

SteadyOptions quiet(double tolerance) {
  SteadyOptions options;
  options.tolerance = tolerance;
  options.progress = false;
  return options;
}

TEST(Profile, IsExactForCubics) {
  const auto cubic = [](double x) { return ((2 * x - 3) * x + 0.5) * x - 1; };  // minimum at 1/2 + sqrt(1/4 - 1/12)
  Profile profile;
  for (const double x : {0.0, 0.05, 0.15, 0.4, 0.5, 0.8, 0.9, 1.0}) {
    profile.positions.push_back(x);
    profile.values.push_back(cubic(x));
  }
  for (const double x : {0.0, 0.01, 0.3, 0.5, 0.97, 1.0}) EXPECT_NEAR(profile.at(x), cubic(x), 1e-14);
  const double lowest = 0.5 + std::sqrt(0.25 - 1.0 / 12);
  EXPECT_NEAR(profile.minimum().position, lowest, 4e-4);
  EXPECT_NEAR(profile.minimum().value, cubic(lowest), 1e-6);
  EXPECT_NEAR(profile.maximum().value, cubic(1 - lowest), 1e-6);
  EXPECT_THROW(profile.at(1.01), std::invalid_argument);
  EXPECT_THROW(profile.at(-0.01), std::invalid_argument);
}

// Products of cubics across the line are interpolated exactly, with even and odd numbers of cells.
TEST(Profile, IsTakenThroughTheMiddle) {
  for (const int cells : {8, 9}) {
    const Grid grid({0, 0, 0}, {1, 1, 1}, {cells, cells, cells});
    FaceVector velocity(grid);
    const auto u = [](const Vector3& p) { return (1 + p[1]) * (1 + p[0] * p[0] * p[0]) * (2 - p[2] * p[2]); };
    for (int k = -1; k <= cells; ++k)
      for (int j = -1; j <= cells; ++j)
        for (int i = -1; i <= cells + 1; ++i) velocity.x(i, j, k) = u(velocity.x.position(i, j, k));
    const Profile line = centreline(velocity, 0, 1);
    EXPECT_EQ(line.positions.size(), static_cast<std::size_t>(cells + 2));
    for (std::size_t p = 0; p < line.positions.size(); ++p)
      EXPECT_NEAR(line.values[p], u({0.5, line.positions[p], 0.5}), 1e-13) << cells << ' ' << line.positions[p];
    EXPECT_EQ(line.positions.front(), 0);
    EXPECT_EQ(line.positions.back(), 1);
  }
}

TEST(Published, PointsAreThoseOfTheMovingWallAtTheTop) {
  const auto u = albensoeder_kuhlmann::u_along_y(), v = albensoeder_kuhlmann::v_along_x();
  ASSERT_EQ(u.size(), 15u);
  ASSERT_EQ(v.size(), 15u);
  EXPECT_DOUBLE_EQ(u.front().position, 0.9766);
  EXPECT_DOUBLE_EQ(u.front().value, 0.58964);
  EXPECT_DOUBLE_EQ(v[10].position, 0.9063);  // down along the wall that the lid moves to
  EXPECT_DOUBLE_EQ(v[10].value, -0.43423);
}

TEST(Extrapolation, RemovesTheSecondOrderError) {
  const auto value = [](double h) { return 3 + 5 * h * h; };
  EXPECT_NEAR(extrapolated(value(0.3), value(0.2), 1.5), 3, 1e-14);
}

TEST(Deviation, IsRootMeanSquareAndMaximum) {
  const std::vector<PublishedPoint> points = {{0, 1}, {0.5, 2}};
  const std::vector<double> values = {1.3, 1.6};
  const Deviation found = deviation(values, points);
  EXPECT_NEAR(found.rms, std::sqrt((0.09 + 0.16) / 2), 1e-15);
  EXPECT_NEAR(found.max, 0.4, 1e-15);
}

// Without inertia the equations have the mirror plane x = 1/2 (with time reversed): u is even in x - 1/2 and v is odd.
TEST(Cavity, IsSymmetricWithoutInertia) {
  const CavityFlow flow = compute_cavity(10, 1e-4, quiet(1e-6));
  ASSERT_TRUE(flow.run.steady);
  const auto& u = flow.velocity.x;
  for (int j = 0; j < 10; ++j)
    for (int i = 1; i < 5; ++i) EXPECT_NEAR(u(i, j, 4), u(10 - i, j, 4), 1e-5);
  for (const double x : {0.1, 0.2, 0.4}) EXPECT_NEAR(flow.v_along_x.at(x), -flow.v_along_x.at(1 - x), 1e-5);
}

// At every Reynolds number the flow has the mirror plane z = 1/2; nothing passes the cross-sections on the whole; the lid and
// the bottom are where the profile ends.
TEST(Cavity, KeepsItsMirrorPlaneAndItsVolume) {
  const CavityFlow flow = compute_cavity(12, 100, quiet(1e-4));
  ASSERT_TRUE(flow.run.steady);
  const auto& [u, v, w] = flow.velocity;
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) {
      EXPECT_NEAR(u(i, j, 2), u(i, j, 9), 1e-12);
      EXPECT_NEAR(v(i, j, 2), v(i, j, 9), 1e-12);
      EXPECT_NEAR(w(i, j, 3), -w(i, j, 9), 1e-12);
    }
  double through = 0;
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 12; ++j) through += u(6, j, k) / (12 * 12);
  EXPECT_NEAR(through, 0, 1e-14);
  EXPECT_NEAR(flow.u_along_y.values.back(), 1, 1e-14);
  EXPECT_NEAR(flow.u_along_y.values.front(), 0, 1e-14);
  EXPECT_LT(flow.v_minimum().value, -flow.v_maximum().value);  // inertia carries the fluid to the wall ahead
}

// The steady state is of the equations, not of the way to it: a start from another grid's flow and another step change nothing.
TEST(Cavity, SteadyStateDoesNotDependOnStartAndStep) {
  const CavityFlow rest = compute_cavity(12, 100, quiet(1e-7));
  SteadyOptions options = quiet(1e-7);
  options.time_step = 0.01;
  const CavityFlow other = compute_cavity(8, 100, quiet(1e-3));
  const CavityFlow continued = compute_cavity(12, 100, options, &other.velocity);
  EXPECT_LT(max_difference(rest.velocity, continued.velocity), 1e-6);
}

TEST(SteadyRun, StopsAtTheEndAndSaysSo) {
  SteadyOptions options = quiet(1e-12);
  options.end = 0.2;
  const CavityFlow flow = compute_cavity(8, 100, options);
  EXPECT_FALSE(flow.run.steady);
  EXPECT_GE(flow.run.time, 0.2);
  EXPECT_GT(flow.run.change, 1e-3);
}

TEST(SteadyRun, EndsWhenItBlowsUp) {
  SteadyOptions options = quiet(1e-6);
  options.time_step = 1;
  EXPECT_THROW(compute_cavity(16, 1e4, options), std::runtime_error);
}

// A uniform flow u on a grid of spacing h crosses it at u/h.
TEST(SteadyRun, CourantRateAddsTheAxes) {
  const Grid grid({0, 0, 0}, {1, 1, 2}, {8, 10, 8});
  FaceVector velocity(grid);
  velocity.x.fill(0.5);
  velocity.y.fill(-2);
  velocity.z.fill(1);
  EXPECT_NEAR(courant_rate(velocity), 0.5 * 8 + 2 * 10 + 1 * 4, 1e-12);
}

}  // namespace
