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

#include "files/hdf5_file.h"
#include "run/errors.h"
#include "run/plan.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::run_files_test {
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

// Of a fluid that is solved for mu u they hold u, as a mean of two faces.
TEST_F(RunFiles, SnapshotsHoldTheVelocityOfTheFluidWhateverItWasSolvedFor) {
  const Scene scene = small_scene({"coupling.method=sharp", "fluid.inertia=none", "fluid.viscosity_ratio=5",
                                   "time.markers=shape_following", "domain.cells=16", "time.step=1/24", "time.end=2/24",
                                   "output.fluid_every=1/24"});
  SceneSimulation simulation(scene);
  run(simulation, options_in(at("run")));
  const auto stored = [&](const char* name) {
    return Hdf5File(at("run") / "snapshots" / name, Hdf5File::Mode::read).read("/velocity");
  };
  const std::vector<double> at_start = stored("fluid_000000000.h5"), at_end = stored("fluid_000000002.h5");
  const fluid::Field<fluid::FaceX>& u = simulation.fluid_velocity().x;
  const fluid::Field<fluid::FaceX>& w = simulation.fluid().velocity().x;
  ASSERT_EQ(at_end.size(), 3U * 16 * 16 * 16);
  EXPECT_NEAR(w(8, 8, 9) / u(8, 8, 9), 5.0, 1e-12) << "or this tests nothing";
  for (int k = 0; k < 16; ++k) {
    const std::size_t place = 3U * ((static_cast<std::size_t>(k) * 16 + 8) * 16 + 8);
    EXPECT_NEAR(at_end[place], 0.5 * (u(8, 8, k) + u(9, 8, k)), 1e-6) << k;
    EXPECT_NEAR(at_start[place], -3.0 + (k + 0.5) * 0.375, 1e-6) << k;  // undisturbed
  }
}

// Only where there are any: else the summary has no number of them.
TEST_F(RunFiles, SummaryCountsTheSolvesForTheVelocitiesOfInterfaces) {
  const auto said = [&](const char* name, std::initializer_list<std::string> more) {
    Overrides overrides{"time.markers=shape_following", "domain.cells=16",   "time.step=1/24", "time.end=3/24",
                        "coupling.method=sharp",        "fluid.inertia=none"};
    overrides.insert(overrides.end(), more);
    long solves = 0, last = 0;
    SceneSimulation simulation(small_scene(overrides));
    RunOptions options = options_in(at(name));
    options.after_step = [&](const SceneSimulation& now) { solves += last = now.interface_passes(); };
    run(simulation, options);
    const std::string summary = text_of(at(name) / "summary.json");
    const std::regex null(R"("interface_passes": null)"),
        numbers(R"re("interface_passes": \{\s*"last_step": (\d+),\s*"per_step": ([0-9.]+)\s*\})re");
    std::smatch found;
    if (std::regex_search(summary, null)) return 0.0;
    EXPECT_TRUE(std::regex_search(summary, found, numbers)) << summary;
    EXPECT_EQ(std::stol(found[1]), last);
    EXPECT_NEAR(std::stod(found[2]), static_cast<double>(solves) / 3.0, 1e-6);
    return std::stod(found[2]);
  };
  EXPECT_EQ(said("equal", {}), 0.0);
  EXPECT_GT(said("two", {"fluid.viscosity_ratio=5"}), 1.0);
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
}  // namespace vesiflow::run::run_files_test
