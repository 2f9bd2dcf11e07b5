// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads of the host program, each with objects of its own.
#include <gtest/gtest.h>

#include <thread>

#include "fluid/navier_stokes.h"
#include "support/planning_host.h"

using namespace vesiflow::fluid;

namespace {

// Long enough lines for FFTW to be asked.
Grid grid(int n) {
  return Grid({-1, -1, -1}, {1, 1, 1}, {n, n + 1, n + 2});
}

}  // namespace

TEST(Threads, ATransformIsPlannedWhenThePlannerIsFree) {
  for (const FftOptions::Transforms transforms :
       {FftOptions::Transforms::pairs_of_lines, FftOptions::Transforms::fftw_r2r}) {
    PlanningHost host;
    const EllipticProblem problem{grid(24), Centring::cell, BoundaryCondition::neumann, 0.0, 1.0};
    const auto solver = make_elliptic_solver(problem, FftOptions{transforms});
    EXPECT_LT(host.planning_left(), 0.01) << "two threads were in FFTW's planner";
  }
}

TEST(Threads, FluidsAreMadeAndDestroyedSideBySide) {
  const auto make = [] {
    const auto at_rest = [](const Vector3&, double) { return Vector3{0, 0, 0}; };
    for (int n = 20; n < 28; ++n) EXPECT_EQ(NavierStokes(grid(n), FluidParameters{}, at_rest).steps(), 0);
  };
  std::thread one(make), other(make);
  one.join();
  other.join();
}
