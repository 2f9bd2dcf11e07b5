// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads of the host program, each with objects of its own.
#include <gtest/gtest.h>

#include <thread>

#include "support/planning_host.h"
#include "vesicle/surface.h"

using namespace vesiflow::vesicle;

TEST(Threads, ATransformIsPlannedWhenThePlannerIsFree) {
  PlanningHost host;
  const Surface surface(12);
  EXPECT_LT(host.planning_left(), 0.01) << "two threads were in FFTW's planner";
}

TEST(Threads, SurfacesAreMadeAndDestroyedSideBySide) {
  const auto make = [] {
    for (int latitudes = 5; latitudes < 25; ++latitudes) EXPECT_EQ(Surface(latitudes).grid().latitudes(), latitudes);
  };
  std::thread one(make), other(make);
  one.join();
  other.join();
}
