// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan_totals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "run/plan.h"
#include "run/run.h"
#include "support/small_scene.h"

namespace vesiflow::run::plan_totals_test {
namespace {

namespace fs = std::filesystem;

TEST(PlanTotals, SaysTimesInTheUnitThatSuits) {
  EXPECT_EQ(duration(0.015), "15 ms");
  EXPECT_EQ(duration(0.25), "0.25 s");
  EXPECT_EQ(duration(24.3), "24 s");
  EXPECT_EQ(duration(192.0), "3.2 min");
  EXPECT_EQ(duration(5400.0), "1.5 h");
  EXPECT_EQ(duration(8.64e5), "10 days");
}

// Two threads gain 1.4, as was measured; more of them than there are cores gain nothing.
TEST(PlanTotals, EndThePlan) {
  const Scene scene = coupling::small_scene();
  const std::string alone = describe_totals(scene, 1, "out/x");
  EXPECT_NE(alone.find(" by one thread: 48 steps of "), std::string::npos) << alone;
  EXPECT_NE(alone.find("the file system of out/x has "), std::string::npos) << alone;
  EXPECT_TRUE(describe_plan(scene, 1, "out/x").ends_with(alone));
  EXPECT_EQ(describe_totals(scene, 1000, "."), describe_totals(scene, 1001, "."));
}

TEST(PlanTotals, WarnsOfADiskThatIsTooSmall) {
  const Scene large =
      coupling::small_scene({"domain.cells=2048", "time.step=1e-3", "time.end=1e4", "output.fluid_every=0.01"});
  EXPECT_NE(describe_totals(large, 1, ".").find("<- WARNING: too little"), std::string::npos);
  EXPECT_EQ(describe_totals(coupling::small_scene(), 1, ".").find("WARNING"), std::string::npos);
}

// What a run leaves, and the checkpoint that is written while the last one is still there.
TEST(PlanTotals, OutputTakesAsMuchAsPlanned) {
  const Scene scene = coupling::small_scene({"time.end=0.125", "output.vesicle_every=0.01", "output.fluid_every=0.02"});
  const fs::path folder = fs::temp_directory_path() / ("vesiflow_plan_totals_" + std::to_string(getpid()));
  SceneSimulation simulation(scene);
  RunOptions options;
  options.directory = folder;
  options.quiet = true;
  run(simulation, options);
  double bytes = static_cast<double>(fs::file_size(folder / "checkpoint.h5"));
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  fs::remove_all(folder);
  EXPECT_NEAR(output_bytes(scene), bytes, 0.15 * bytes);
}

}  // namespace
}  // namespace vesiflow::run::plan_totals_test
