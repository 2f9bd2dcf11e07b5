// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Threads of the host program, each with objects of its own.
#include <gtest/gtest.h>
#include <omp.h>

#include <string>
#include <thread>

#include "coupling/simulation.h"
#include "support/small_scene.h"

using namespace vesiflow;
using namespace vesiflow::coupling;

// libvesicle and libfluid know nothing of each other, and plan with the same planner.
TEST(Threads, SurfacesAndFluidsAreMadeSideBySide) {
  std::thread surfaces([] {
    omp_set_num_threads(1);
    for (int i = 0; i < 10; ++i)
      for (int latitudes = 5; latitudes < 25; ++latitudes) vesicle::Surface made(latitudes);
  });
  std::thread fluids([] {
    omp_set_num_threads(1);
    for (int i = 0; i < 10; ++i)
      for (int n = 18; n < 26; ++n)
        fluid::NavierStokes made(fluid::Grid({-1, -1, -1}, {1, 1, 1}, {n, n + 1, n + 2}), {},
                                 [](const fluid::Vector3&, double) {
                                   return fluid::Vector3{0, 0, 0};
                                 });
  });
  surfaces.join();
  fluids.join();
}

// As a sweep of parameters does.
TEST(Threads, SimulationsSideBySideTakeTheStepsTheyTakeAlone) {
  const auto markers_of = [](int latitudes) {
    omp_set_num_threads(1);
    SceneSimulation simulation(small_scene({"mesh.latitudes=" + std::to_string(latitudes)}));
    for (int i = 0; i < 3; ++i) simulation.step();
    return vesicle::VectorField(simulation.membrane(0).positions());
  };
  vesicle::VectorField one, other;
  std::thread first([&] { one = markers_of(16); }), second([&] { other = markers_of(18); });
  first.join();
  second.join();
  std::thread alone([&] {
    EXPECT_TRUE((one == markers_of(16)).all());
    EXPECT_TRUE((other == markers_of(18)).all());
  });
  alone.join();
}
