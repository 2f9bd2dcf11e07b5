// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/memory_plan.h"

#include <gtest/gtest.h>

#include <string>

#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::run::memory_plan_test {
namespace {

Scene without_output(int cells, int latitudes, std::size_t vesicles) {
  Scene scene;
  scene.domain.cells.fill(cells);
  scene.mesh.latitudes = latitudes;
  scene.output = {0.0, 0.0, 0.0, 0.0};
  scene.vesicles.resize(vesicles);
  for (coupling::VesicleParameters& vesicle : scene.vesicles) vesicle.reduced_volume = 0.9;
  return scene;
}

// Peak resident megabytes of `vesicles` with the scenes of bench/studies/growth.py, two steps on 40^3 cells.
TEST(MemoryPlan, IsWithinATenthOfWhatWasMeasuredForAnyNumberOfVesicles) {
  struct Measured {
    int latitudes;
    std::size_t vesicles;
    double peak;
  };
  constexpr Measured all[] = {{16, 1, 32.3},  {16, 8, 45.2},   {16, 32, 91.0},  {32, 1, 40.6},
                              {32, 8, 88.9},  {32, 32, 256.3}, {64, 1, 80.4},   {64, 8, 267.9},
                              {96, 1, 166.0}, {96, 4, 344.3},  {128, 1, 310.0}, {128, 2, 415.2}};
  for (const Measured& m : all) {
    const double planned = 1e-6 * plan_memory(without_output(40, m.latitudes, m.vesicles)).total();
    EXPECT_NEAR(planned / m.peak, 1.0, 0.1) << m.latitudes << " latitudes, " << m.vesicles << " vesicles";
  }
}

TEST(MemoryPlan, CountsTablesOncePerNumberOfLatitudes) {
  const auto membranes = [](const Scene& scene) { return plan_memory(scene).membranes; };
  const double one = membranes(without_output(32, 64, 1));
  const double two = membranes(without_output(32, 64, 2));
  const double three = membranes(without_output(32, 64, 3));
  EXPECT_DOUBLE_EQ(three - two, two - one);
  EXPECT_LT(two, 1.7 * one);
  Scene mixed = without_output(32, 64, 2);
  mixed.vesicles[1].latitudes = 32;
  EXPECT_DOUBLE_EQ(membranes(mixed), one + membranes(without_output(32, 32, 1)));
}

TEST(MemoryWarning, NamesWhatASceneTakesAndWhatThereIs) {
  EXPECT_EQ(memory_warning(coupling::small_scene()), "");
  const std::string warning = memory_warning(coupling::small_scene({"domain.cells=2048"}));
  EXPECT_NE(warning.find("this scene takes about"), std::string::npos) << warning;
}

}  // namespace
}  // namespace vesiflow::run::memory_plan_test
