// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What a run writes, and when.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "run/errors.h"
#include "run/plan.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run {
namespace {

using coupling::small_scene;

class RunFiles : public RunInFolder {};

TEST_F(RunFiles, AdaptiveRunWritesEachIntervalOnce) {
  run_scene(small_scene({"time.adaptive=true", "time.tolerance=4e-5", "output.diagnostics_every=0.05"}), at("run"));
  std::istringstream table(text_of(at("run") / "diagnostics.csv"));
  std::string row;
  std::getline(table, row);
  std::vector<double> times;
  while (std::getline(table, row)) times.push_back(std::stod(row.substr(row.find(',') + 1)));
  ASSERT_EQ(times.size(), 11U);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_GE(times[k], 0.05 * static_cast<double>(k) - 1e-9);
    EXPECT_LT(times[k], 0.05 * static_cast<double>(k + 1) - 1e-9);
  }
  EXPECT_DOUBLE_EQ(times.back(), 0.5);
}

TEST_F(RunFiles, SwitchedOffOutputIsNotWritten) {
  run_scene(small_scene({"time.end=0.1", "output.diagnostics_every=0", "output.vesicle_every=0", "output.fluid_every=0",
                         "output.checkpoint_every=0"}),
            at("run"));
  EXPECT_TRUE(fs::exists(at("run") / "summary.json"));
  for (const char* file : {"diagnostics.csv", "vesicle.h5", "fluid.h5", "checkpoint.h5"})
    EXPECT_FALSE(fs::exists(at("run") / file)) << file;
}

TEST_F(RunFiles, EarlierResultsAreKept) {
  run_scene(small_scene({"time.end=0.1"}), at("run"));
  const std::string earlier = text_of(at("run") / "diagnostics.csv");
  run_scene(small_scene({"time.end=0.1", "flow.rate=2"}), at("run"));
  EXPECT_EQ(text_of(at("run") / "previous_1" / "diagnostics.csv"), earlier);
  EXPECT_NE(text_of(at("run") / "diagnostics.csv"), earlier);
}

TEST_F(RunFiles, EarlierSnapshotsMoveWithTheirLists) {
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  run_scene(small_scene({"time.end=0.05", "output.fluid_every=0"}), at("run"));
  EXPECT_TRUE(fs::exists(at("run") / "previous_1" / "snapshots" / "fluid_000000000.h5"));
  EXPECT_TRUE(fs::exists(at("run") / "snapshots" / "vesicle_000000000.h5"));
  EXPECT_FALSE(fs::exists(at("run") / "snapshots" / "fluid_000000000.h5"));
}

TEST_F(RunFiles, LeftoversOfAKillAreRemoved) {
  fs::create_directories(at("run"));
  fs::create_directories(at("run") / "snapshots");
  const fs::path list = at("run") / "vesicle.h5.part", snapshot = at("run") / "snapshots" / "fluid_000000007.h5.part",
                 lock = at("run") / "run.lock.a1B2c3.part", of_the_user = at("run") / "film.mp4.part";
  for (const fs::path& part : {list, snapshot, lock, of_the_user}) std::ofstream(part) << "half a file";
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  for (const fs::path& part : {list, snapshot, lock}) EXPECT_FALSE(fs::exists(part)) << part;
  EXPECT_TRUE(fs::exists(of_the_user));
}

// Numbers and sizes of the files that the plan speaks of are those that a run writes.
TEST_F(RunFiles, PlanSaysHowManySnapshotsThereWillBeAndOfWhatSize) {
  const Scene scene = small_scene({"time.end=0.25", "output.vesicle_every=1/24", "output.fluid_every=0.1"});
  run_scene(scene, at("run"));
  const std::string plan = describe_plan(scene, 1);
  for (const auto& [name, label] :
       {std::pair{"vesicle", "snapshots of membranes"}, {"fluid", "snapshots of the fluid"}}) {
    double files = 0.0, bytes = 0.0;
    for (const auto& entry : fs::directory_iterator(at("run") / "snapshots"))
      if (entry.path().filename().string().starts_with(name)) {
        ++files;
        bytes += static_cast<double>(entry.file_size());
      }
    std::smatch said;
    ASSERT_TRUE(std::regex_search(
        plan, said, std::regex(std::string(label) + " +every .*: (.*) files of (.*) MB, in all about (.*) MB")));
    EXPECT_EQ(std::stod(said[1]), files) << name;
    EXPECT_NEAR(std::stod(said[2]) / (1e-6 * bytes / files), 1.0, 0.03) << name;
    EXPECT_NEAR(std::stod(said[3]) / (1e-6 * bytes), 1.0, 0.03) << name;
  }
}

TEST_F(RunFiles, CallsBackAfterEachStepAndBeforeEachOutput) {
  const Scene scene =
      small_scene({"time.step=1/32", "time.end=0.125", "output.diagnostics_every=1/32", "output.vesicle_every=1/16",
                   "output.fluid_every=0", "output.checkpoint_every=0.125"});
  SceneSimulation simulation(scene);
  RunOptions options = options_in(at("run"));
  std::string calls;
  options.after_step = [&](const SceneSimulation& now) { calls += " " + std::to_string(now.steps()); };
  options.before_output = [&](const SceneSimulation&, RunOutput output) {
    calls += std::string("dvfc").at(static_cast<std::size_t>(output));
    EXPECT_EQ(fs::exists(at("run") / "checkpoint.h5"), false);  // it is not there before it is written
  };
  EXPECT_EQ(run(simulation, options), RunStatus::completed);
  EXPECT_EQ(calls, "dv 1d 2dv 3d 4dvc");
}

TEST_F(RunFiles, WritesDiagnosticsOfAProgramsOwn) {
  const Scene scene = small_scene({"time.end=0.1"});
  RunOptions options = options_in(at("run"));
  options.diagnostics = {{"highest", [](SceneSimulation& simulation, std::size_t i) {
                            return simulation.membrane(i).positions().col(2).maxCoeff();
                          }}};
  SceneSimulation simulation(scene);
  run(simulation, options);
  std::istringstream rows(text_of(at("run") / "diagnostics.csv"));
  std::string header, row, last;
  std::getline(rows, header);
  EXPECT_TRUE(header.ends_with(",highest")) << header;
  while (std::getline(rows, row)) last = row;
  EXPECT_NEAR(std::stod(last.substr(last.rfind(',') + 1)), simulation.membrane(0).positions().col(2).maxCoeff(), 1e-9);

  SceneSimulation longer(small_scene({"time.end=0.2"}));
  RunOptions without = options;
  without.diagnostics.clear();
  without.checkpoint = at("run") / "checkpoint.h5";
  EXPECT_THROW(run(longer, without), SceneError);
  for (const char* name : {"", "time", "a,b"}) {
    RunOptions wrong = options;
    wrong.diagnostics.front().name = name;
    SceneSimulation again(scene);
    EXPECT_THROW(run(again, wrong), SceneError) << name;
  }
}

}  // namespace
}  // namespace vesiflow::run
