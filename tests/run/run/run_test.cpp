// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run.h"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/marker_integrator.h"
#include "files/folder_lock.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::run {
namespace {

using coupling::have_sundials, coupling::SimulationStopped, coupling::small_scene, coupling::three_vesicles;

namespace fs = std::filesystem;

class RunTest : public testing::Test {
 protected:
  RunTest()
      : folder_(fs::temp_directory_path() / ("vesiflow_run_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~RunTest() override { fs::remove_all(folder_); }

  fs::path at(const char* name) const { return folder_ / name; }

  RunStatus run_scene(const Scene& scene, const fs::path& directory,
                      const std::optional<fs::path>& checkpoint = std::nullopt) const {
    SceneSimulation simulation(scene);
    RunOptions options;
    options.directory = directory;
    options.checkpoint = checkpoint;
    options.quiet = true;
    return run(simulation, options);
  }

  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  fs::path folder_;
};

// The final state of a run, for comparison to the last bit.
void expect_same_state(const fs::path& a, const fs::path& b, const Scene& scene) {
  SceneSimulation first(scene), second(scene);
  restore_checkpoint(a, first);
  restore_checkpoint(b, second);
  const coupling::SimulationState x = first.state(), y = second.state();
  EXPECT_EQ(x.clock.steps, y.clock.steps);
  EXPECT_EQ(x.clock.time, y.clock.time);
  const auto same = [](const auto& f, const auto& g) { return std::equal(f.data(), f.data() + f.size(), g.data()); };
  EXPECT_TRUE(same(x.velocity.x, y.velocity.x));
  EXPECT_TRUE(same(x.velocity.y, y.velocity.y));
  EXPECT_TRUE(same(x.velocity.z, y.velocity.z));
  EXPECT_TRUE(same(x.previous_velocity.x, y.previous_velocity.x));
  EXPECT_TRUE(same(x.pressure, y.pressure));
  for (std::size_t i = 0; i < x.vesicles.size(); ++i) {
    EXPECT_TRUE((x.vesicles[i].membrane.positions == y.vesicles[i].membrane.positions).all());
    EXPECT_TRUE((x.vesicles[i].membrane.target_areas == y.vesicles[i].membrane.target_areas).all());
    EXPECT_TRUE((x.vesicles[i].membrane.initial_areas == y.vesicles[i].membrane.initial_areas).all());
    EXPECT_TRUE((x.vesicles[i].membrane.lagged_strain == y.vesicles[i].membrane.lagged_strain).all());
    EXPECT_TRUE((x.vesicles[i].membrane.integral_tension == y.vesicles[i].membrane.integral_tension).all());
    EXPECT_EQ(x.vesicles[i].motion_history, y.vesicles[i].motion_history);
    EXPECT_EQ(x.vesicles[i].redistributions, y.vesicles[i].redistributions);
  }
  EXPECT_EQ(x.step_control, y.step_control);
}

void compare_restart(const fs::path& folder, const Overrides& overrides, int threads,
                     Scene (*make_scene)(const Overrides&) = small_scene) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  const auto go = [&](const Scene& scene, const fs::path& directory, const std::optional<fs::path>& checkpoint) {
    SceneSimulation simulation(scene);
    RunOptions options;
    options.directory = directory;
    options.checkpoint = checkpoint;
    options.quiet = true;
    EXPECT_EQ(run(simulation, options), RunStatus::completed);
  };
  Overrides half = overrides;
  half.emplace_back("time.end=0.25");
  const Scene whole_scene = make_scene(overrides);
  go(whole_scene, folder / "whole", std::nullopt);
  go(make_scene(half), folder / "parts", std::nullopt);
  go(whole_scene, folder / "parts", folder / "parts" / "checkpoint.h5");
  expect_same_state(folder / "whole" / "checkpoint.h5", folder / "parts" / "checkpoint.h5", whole_scene);
  omp_set_num_threads(before);
}

TEST_F(RunTest, RestartContinuesBitForBitWithOneThread) {
  compare_restart(folder_, {}, 1);
}
TEST_F(RunTest, RestartContinuesBitForBitWithTwoThreads) {
  compare_restart(folder_, {}, 2);
}
TEST_F(RunTest, RestartContinuesBitForBitWithMarkerHistory) {
  compare_restart(folder_, {"time.markers=ab2", "membrane.g=2"}, 2);
}
/// Redistributed at steps 16, 32 and 48; the checkpoint is of step 24.
TEST_F(RunTest, RestartContinuesBitForBitThroughRedistributions) {
  const Overrides always = {"mesh.max_aspect_ratio=1", "time.markers=ab2", "membrane.g=2"};
  compare_restart(folder_, always, 2);
  SceneSimulation simulation(small_scene(always));
  restore_checkpoint(at("parts") / "checkpoint.h5", simulation);
  EXPECT_EQ(simulation.redistributions(0), 3);
}
TEST_F(RunTest, RestartContinuesBitForBitWithThePaperPreset) {
  compare_restart(folder_, {"method.preset=paper", "fluid.reynolds_number=1"}, 2);
}

// Latitudes, forces and redistributions of their own.
TEST_F(RunTest, RestartContinuesSeveralVesiclesBitForBit) {
  compare_restart(folder_, {"mesh.max_aspect_ratio=1.5", "time.markers=ab2", "membrane.g=1.5"}, 2, three_vesicles);
  const std::string header = text_of(at("whole") / "diagnostics.csv").substr(0, 600);
  EXPECT_NE(header.find(",min_distance\n"), std::string::npos) << header;
}

// Nothing is written again, and nothing moved aside; a run whose summary does not say so yet ends once more.
TEST_F(RunTest, RestartOfACompleteRunChangesNothing) {
  const Scene scene = small_scene({"time.end=0.03"});
  run_scene(scene, at("run"));
  const std::string summary = text_of(at("run") / "summary.json");
  EXPECT_EQ(run_scene(scene, at("run"), at("run") / "checkpoint.h5"), RunStatus::completed);
  EXPECT_EQ(text_of(at("run") / "summary.json"), summary);
  std::ofstream(at("run") / "summary.json") << "{}";
  EXPECT_EQ(run_scene(scene, at("run"), at("run") / "checkpoint.h5"), RunStatus::completed);
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"completed\""), std::string::npos);
}

TEST_F(RunTest, RestartRefusesAVesicleWithAnotherPropertyOfItsOwn) {
  const auto refusal = [&](const Overrides& overrides) -> std::string {
    SceneSimulation simulation(three_vesicles(overrides));
    try {
      restore_checkpoint(at("run") / "checkpoint.h5", simulation);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  run_scene(three_vesicles({"time.end=0.05"}), at("run"));
  EXPECT_EQ(refusal({}), "accepted");
  EXPECT_NE(refusal({"vesicles.1.latitudes=24"}).find("vesicles.1.latitudes = 20, this scene has 24"),
            std::string::npos);
  EXPECT_NE(refusal({"vesicles.0.sigma0=100"}).find("vesicles.0.sigma0 = absent, this scene has 100.0"),
            std::string::npos);
}

// The field of viscosity is made anew from the markers; the velocity and the pressure to start iterations from are in the state.
TEST_F(RunTest, RestartContinuesBitForBitWithEveryTreatmentOfTheViscosity) {
  const Overrides contrast{"fluid.viscosity_ratio=5", "domain.cells=16", "time.step=1/32", "time.end=0.375",
                           "output.checkpoint_every=0.125"};
  for (const char* treatment : {"explicit", "extrapolated", "implicit"}) {
    Overrides overrides = contrast;
    overrides.push_back(std::string("fluid.viscous_treatment=") + treatment);
    compare_restart(folder_ / treatment, overrides, 2);
  }
  Overrides without_inertia = contrast;
  without_inertia.emplace_back("fluid.inertia=none");
  compare_restart(folder_ / "none", without_inertia, 2);
}

TEST_F(RunTest, RestartContinuesBitForBitWithVesiclesOfTheirOwnViscosity) {
  Scene scene = small_scene({"domain.cells=[36, 16, 16]", "domain.upper=[9, 3, 3]", "time.step=1/32", "time.end=0.25",
                             "output.checkpoint_every=0.125"});
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[0].viscosity_ratio = 8.0;
  scene.vesicles[1].centre = {5.0, 0.0, 0.0};
  scene.vesicles[1].viscosity_ratio = 0.2;
  run_scene(scene, at("whole"));
  Scene half = scene;
  half.time.end = 0.125;
  run_scene(half, at("parts"));
  run_scene(scene, at("parts"), at("parts") / "checkpoint.h5");
  expect_same_state(at("whole") / "checkpoint.h5", at("parts") / "checkpoint.h5", scene);
}

TEST_F(RunTest, RestartContinuesBitForBitWithWhatTheTensionRemembers) {
  compare_restart(folder_, {"time.markers=strain_relaxation", "membrane.integral_rate=2"}, 2);
}
TEST_F(RunTest, RestartContinuesBitForBitWithArkode) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  compare_restart(folder_, {"time.markers=arkode", "time.fluid_velocity=interpolated"}, 2);
}

// Three vesicles of different latitudes, each with its own forces, strain field and corrections that the fluid is owed.
const Overrides small_three{"domain.cells=[24, 16, 16]", "vesicles.0.latitudes=12", "vesicles.1.latitudes=14",
                            "vesicles.2.latitudes=10", "mesh.tangential_degrees=8"};

Overrides small_three_with(std::initializer_list<const char*> more) {
  Overrides all = small_three;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST_F(RunTest, RestartContinuesSeveralVesiclesBitForBitWithShapeFollowing) {
  compare_restart(folder_ / "one", small_three_with({"time.markers=shape_following", "time.step=1/48"}), 1,
                  three_vesicles);
  compare_restart(folder_ / "two", small_three_with({"time.markers=shape_following", "time.step=1/48"}), 2,
                  three_vesicles);
}
/// Markers are redistributed in steps 16 and 32; the checkpoint is of step 24, and the motions have started anew before it.
TEST_F(RunTest, RestartContinuesShapeFollowingBitForBitThroughRedistributions) {
  const Overrides always = small_three_with({"time.markers=shape_following", "mesh.max_aspect_ratio=1"});
  compare_restart(folder_, always, 2, three_vesicles);
  SceneSimulation simulation(three_vesicles(always));
  restore_checkpoint(at("parts") / "checkpoint.h5", simulation);
  EXPECT_GT(simulation.redistributions(0), 1);
}
TEST_F(RunTest, RestartContinuesShapeFollowingBitForBitWithAViscosityContrast) {
  for (const char* treatment : {"explicit", "extrapolated", "implicit"})
    compare_restart(folder_ / treatment,
                    small_three_with({"time.markers=shape_following", "time.step=1/24", "vesicles.0.viscosity_ratio=5",
                                      "vesicles.2.viscosity_ratio=0.5",
                                      (std::string("fluid.viscous_treatment=") + treatment).c_str()}),
                    2, three_vesicles);
  compare_restart(folder_ / "none",
                  small_three_with({"time.markers=shape_following", "time.step=1/16", "vesicles.0.viscosity_ratio=5",
                                    "fluid.inertia=none"}),
                  2, three_vesicles);
}
TEST_F(RunTest, RestartContinuesSeveralVesiclesBitForBitWithStrainRelaxation) {
  compare_restart(folder_, small_three_with({"time.markers=strain_relaxation", "membrane.integral_rate=2"}), 2,
                  three_vesicles);
}
TEST_F(RunTest, RestartContinuesSeveralVesiclesBitForBitWithArkode) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  compare_restart(folder_, small_three_with({"time.markers=arkode", "time.fluid_velocity=interpolated"}), 2,
                  three_vesicles);
}

/// The state between two steps of different lengths, one of them refused, through a file.
TEST_F(RunTest, RestartContinuesSeveralVesiclesBitForBitWithAdaptiveShapeFollowing) {
  fs::create_directories(folder_);
  const Scene scene = three_vesicles(small_three_with(
      {"time.markers=shape_following", "time.adaptive=true", "time.tolerance=3e-5", "time.step=1/24", "time.end=0.4"}));
  SceneSimulation whole(scene), continued(scene);
  while (whole.time() < 0.2) whole.step();
  EXPECT_GT(whole.rejected_steps(), 0);
  write_checkpoint(at("middle.h5"), whole);
  while (!whole.finished()) whole.step();
  write_checkpoint(at("whole.h5"), whole);
  restore_checkpoint(at("middle.h5"), continued);
  while (!continued.finished()) continued.step();
  write_checkpoint(at("continued.h5"), continued);
  expect_same_state(at("whole.h5"), at("continued.h5"), scene);
}

/// With refused steps, and with a history of the integrator beside that of the error.
TEST_F(RunTest, RestartContinuesBitForBitWithAdaptiveSteps) {
  fs::create_directories(folder_);
  for (const char* markers : {"time.markers=euler", "time.markers=ab2", "time.markers=strain_relaxation"}) {
    const Scene scene =
        small_scene({"time.adaptive=true", "time.tolerance=2e-5", "limits.area_error=2e-4", "membrane.g=2", markers});
    SceneSimulation whole(scene), continued(scene);
    for (int i = 0; i < 12; ++i) whole.step();
    EXPECT_GT(whole.rejected_steps(), 0);
    write_checkpoint(at("middle.h5"), whole);
    while (!whole.finished()) whole.step();
    write_checkpoint(at("whole.h5"), whole);
    restore_checkpoint(at("middle.h5"), continued);
    while (!continued.finished()) continued.step();
    write_checkpoint(at("continued.h5"), continued);
    expect_same_state(at("whole.h5"), at("continued.h5"), scene);
  }
}

TEST_F(RunTest, AdaptiveRunWritesEachIntervalOnce) {
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

TEST_F(RunTest, RestartContinuesTheFilesOfItsFolder) {
  const std::string cadence = "output.diagnostics_every=0.125";  // so that the first part ends on it
  run_scene(small_scene({cadence}), at("whole"));
  run_scene(small_scene({cadence, "time.end=0.25"}), at("parts"));
  run_scene(small_scene({cadence}), at("parts"), at("parts") / "checkpoint.h5");
  EXPECT_EQ(text_of(at("whole") / "diagnostics.csv"), text_of(at("parts") / "diagnostics.csv"));
  EXPECT_EQ(text_of(at("whole") / "vesicle.xdmf"), text_of(at("parts") / "vesicle.xdmf"));
  EXPECT_EQ(text_of(at("whole") / "fluid.xdmf"), text_of(at("parts") / "fluid.xdmf"));
  EXPECT_FALSE(fs::exists(at("parts") / "previous_1"));
}

// A run killed after its last checkpoint leaves rows and snapshots beyond it, which the restart computes again.
TEST_F(RunTest, RestartDropsWhatWasWrittenAfterTheCheckpoint) {
  run_scene(small_scene({"time.end=0.25"}), at("run"));
  fs::create_directories(at("kept"));
  fs::copy_file(at("run") / "checkpoint.h5", at("kept") / "checkpoint.h5");
  run_scene(small_scene(), at("run"), at("run") / "checkpoint.h5");
  const std::string whole = text_of(at("run") / "diagnostics.csv"), xdmf = text_of(at("run") / "vesicle.xdmf");
  fs::copy_file(at("kept") / "checkpoint.h5", at("run") / "checkpoint.h5", fs::copy_options::overwrite_existing);
  run_scene(small_scene(), at("run"), at("run") / "checkpoint.h5");
  EXPECT_EQ(text_of(at("run") / "diagnostics.csv"), whole);
  EXPECT_EQ(text_of(at("run") / "vesicle.xdmf"), xdmf);
}

TEST_F(RunTest, EarlierResultsAreKept) {
  run_scene(small_scene({"time.end=0.1"}), at("run"));
  const std::string earlier = text_of(at("run") / "diagnostics.csv");
  run_scene(small_scene({"time.end=0.1", "flow.rate=2"}), at("run"));
  EXPECT_EQ(text_of(at("run") / "previous_1" / "diagnostics.csv"), earlier);
  EXPECT_NE(text_of(at("run") / "diagnostics.csv"), earlier);
}

TEST_F(RunTest, SwitchedOffOutputIsNotWritten) {
  run_scene(small_scene({"time.end=0.1", "output.diagnostics_every=0", "output.vesicle_every=0", "output.fluid_every=0",
                         "output.checkpoint_every=0"}),
            at("run"));
  EXPECT_TRUE(fs::exists(at("run") / "summary.json"));
  for (const char* file : {"diagnostics.csv", "vesicle.h5", "fluid.h5", "checkpoint.h5"})
    EXPECT_FALSE(fs::exists(at("run") / file)) << file;
}

TEST_F(RunTest, BlowUpNamesStepTimeCauseAndCheckpoint) {
  try {
    run_scene(small_scene({"membrane.g=15.5", "time.end=20", "output.checkpoint_every=0.02"}), at("run"));
    FAIL() << "should have stopped";
  } catch (const coupling::SimulationStopped& reason) {
    const std::string message = reason.what();
    for (const char* part : {"step", "t = ", "likely cause", "checkpoint.h5"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"status\": \"stopped\""), std::string::npos);
  SceneSimulation simulation(small_scene({"membrane.g=15.5", "time.end=20"}));
  EXPECT_NO_THROW(restore_checkpoint(at("run") / "checkpoint.h5", simulation));
}

TEST_F(RunTest, RefusesUnusableCheckpointsAndTouchesNothing) {
  run_scene(small_scene({"time.end=0.1"}), at("run"));
  const fs::path good = at("run") / "checkpoint.h5", bad = at("bad.h5");
  const auto refused = [&](const Overrides& overrides, const fs::path& checkpoint) {
    EXPECT_THROW(run_scene(small_scene(overrides), at("other"), checkpoint), SceneError);
    EXPECT_FALSE(fs::exists(at("other")));
  };
  refused({}, at("missing.h5"));
  std::ofstream(bad) << "not a checkpoint";
  refused({}, bad);
  fs::copy_file(good, bad, fs::copy_options::overwrite_existing);
  fs::resize_file(bad, fs::file_size(good) / 2);
  refused({}, bad);
  refused({"fluid.reynolds_number=2"}, good);
  refused({"mesh.latitudes=20"}, good);
}

TEST_F(RunTest, RefusesAFolderThatCannotBeWritten) {
  fs::create_directories(folder_);
  std::ofstream(at("file")) << "in the way";
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("file") / "run"), FileError);
  EXPECT_EQ(text_of(at("file")), "in the way");
}

// A kill within the write of a row leaves a part of it.
TEST_F(RunTest, RestartRemovesATornRowOfTheTable) {
  const std::string cadence = "output.diagnostics_every=0.125";
  run_scene(small_scene({cadence}), at("whole"));
  run_scene(small_scene({cadence, "time.end=0.25"}), at("parts"));
  std::ofstream(at("parts") / "diagnostics.csv", std::ios::app) << "36,0.3";
  run_scene(small_scene({cadence}), at("parts"), at("parts") / "checkpoint.h5");
  EXPECT_EQ(text_of(at("whole") / "diagnostics.csv"), text_of(at("parts") / "diagnostics.csv"));
}

// The list of snapshots for ParaView never names one that is not in the file: a restart takes both back, though its end writes none.
TEST_F(RunTest, RestartDropsSnapshotsFromTheListToo) {
  run_scene(small_scene({"time.end=0.25"}), at("run"));
  fs::create_directories(at("kept"));
  fs::copy_file(at("run") / "checkpoint.h5", at("kept") / "checkpoint.h5");
  const std::string list = text_of(at("run") / "vesicle.xdmf"), fluid_list = text_of(at("run") / "fluid.xdmf");
  run_scene(small_scene(), at("run"), at("run") / "checkpoint.h5");
  EXPECT_NE(text_of(at("run") / "vesicle.xdmf"), list);
  fs::copy_file(at("kept") / "checkpoint.h5", at("run") / "checkpoint.h5", fs::copy_options::overwrite_existing);
  run_scene(small_scene({"time.end=0.25"}), at("run"), at("run") / "checkpoint.h5");
  EXPECT_EQ(text_of(at("run") / "vesicle.xdmf"), list);
  EXPECT_EQ(text_of(at("run") / "fluid.xdmf"), fluid_list);
}

TEST_F(RunTest, LeftoversOfAKillAreRemoved) {
  fs::create_directories(at("run"));
  fs::create_directories(at("run") / "snapshots");
  const fs::path list = at("run") / "vesicle.h5.part", snapshot = at("run") / "snapshots" / "fluid_000000007.h5.part",
                 lock = at("run") / "run.lock.a1B2c3.part", of_the_user = at("run") / "film.mp4.part";
  for (const fs::path& part : {list, snapshot, lock, of_the_user}) std::ofstream(part) << "half a file";
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  for (const fs::path& part : {list, snapshot, lock}) EXPECT_FALSE(fs::exists(part)) << part;
  EXPECT_TRUE(fs::exists(of_the_user));
}

TEST_F(RunTest, EarlierSnapshotsMoveWithTheirLists) {
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  run_scene(small_scene({"time.end=0.05", "output.fluid_every=0"}), at("run"));
  EXPECT_TRUE(fs::exists(at("run") / "previous_1" / "snapshots" / "fluid_000000000.h5"));
  EXPECT_TRUE(fs::exists(at("run") / "snapshots" / "vesicle_000000000.h5"));
  EXPECT_FALSE(fs::exists(at("run") / "snapshots" / "fluid_000000000.h5"));
}

/// Numbers and sizes of the files that the plan speaks of are those that a run writes.
TEST_F(RunTest, PlanSaysHowManySnapshotsThereWillBeAndOfWhatSize) {
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

// Every file, by its name, as it is.
std::map<fs::path, std::string> contents_of(const fs::path& folder) {
  std::map<fs::path, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    contents[entry.path()] = std::string(std::istreambuf_iterator<char>(stream), {});
  }
  return contents;
}

TEST_F(RunTest, ASecondRunInTheSameFolderIsRefusedAndTouchesNothing) {
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  std::ofstream(at("run") / "fluid.h5.part") << "what the first run is writing";
  const FolderLock of_the_first_run(at("run"));
  const auto before = contents_of(at("run"));
  EXPECT_THROW(run_scene(small_scene({"time.end=0.05"}), at("run")), FileError);
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("run"), at("run") / "checkpoint.h5"), FileError);
  EXPECT_EQ(contents_of(at("run")), before);
}

/// A checkpoint that another run is writing is not read: which one it is would be known only afterwards.
TEST_F(RunTest, WhatAnotherRunHasIsNotEvenRead) {
  const Scene scene = small_scene({"time.end=0.05"}), of_other_kind = small_scene({"mesh.latitudes=20"});
  run_scene(scene, at("run"));
  const fs::path checkpoint = at("run") / "checkpoint.h5";
  const FolderLock of_another_run(at("run"));
  EXPECT_THROW(run_scene(scene, at("run"), checkpoint), FileError);  // complete, and yet it may be going on
  EXPECT_THROW(run_scene(of_other_kind, at("run"), checkpoint), FileError);
  EXPECT_THROW(run_scene(of_other_kind, at("elsewhere"), checkpoint), SceneError);
  for (const fs::path& start : {at("run"), checkpoint}) {
    SceneSimulation simulation(three_vesicles({}));
    RunOptions options;
    options.quiet = true;
    options.start_from = start;
    options.directory = at("run");
    EXPECT_THROW(run(simulation, options), FileError);
    options.directory = at("elsewhere");
    EXPECT_THROW(run(simulation, options), SceneError);
  }
}

TEST_F(RunTest, RefusesSnapshotsThatCannotBeRead) {
  const Scene scene = small_scene({"time.end=0.05"});
  run_scene(scene, at("run"));
  fs::remove_all(at("run") / "snapshots");
  std::ofstream(at("run") / "snapshots") << "not a folder";
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("run"), at("run") / "checkpoint.h5"), FileError);
}

// Calls `harm` after the first step of a run and returns what the run says.
std::string error_of_run(const fs::path& folder, const std::function<void()>& harm,
                         const Scene& scene = small_scene({"time.end=0.1", "output.diagnostics_every=1/96"})) {
  SceneSimulation simulation(scene);
  RunOptions options;
  options.directory = folder;
  options.quiet = true;
  options.after_step = [&](const SceneSimulation& now) {
    if (now.steps() == 1) harm();
  };
  try {
    run(simulation, options);
  } catch (const FileError& failure) {
    return failure.what();
  } catch (const coupling::SimulationStopped& reason) {
    return reason.what();
  }
  return "";
}

TEST_F(RunTest, StopsWhereAnotherRunHasTakenItsFolder) {
  const std::string error = error_of_run(at("run"), [&] {
    std::string lock = text_of(at("run") / "run.lock");
    lock.insert(lock.find("since = ") + 8, "later than ");
    std::ofstream(at("run") / "lock") << lock;
    fs::rename(at("run") / "lock", at("run") / "run.lock");
  });
  EXPECT_NE(error.find("in use by another run"), std::string::npos) << error;
  EXPECT_TRUE(fs::exists(at("run") / "run.lock"));
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"status\": \"running\""), std::string::npos);
}

/// The reason for which a run stops is said also where its summary cannot be written.
TEST_F(RunTest, SaysWhyItStoppedWithoutItsSummaryToo) {
  const std::string error = error_of_run(
      at("run"),
      [&] {
        fs::remove(at("run") / "summary.json");
        fs::create_directories(at("run") / "summary.json" / "in the way");
      },
      small_scene({"membrane.g=15.5", "time.end=20", "output.checkpoint_every=0"}));
  EXPECT_NE(error.find("likely cause"), std::string::npos) << error;
}

TEST_F(RunTest, StopsWhereItsFolderIsRemoved) {
  const std::string error = error_of_run(at("run"), [&] { fs::rename(at("run"), at("elsewhere")); });
  EXPECT_NE(error.find("No such file or directory"), std::string::npos) << error;
  EXPECT_FALSE(fs::exists(at("run")));
}

TEST_F(RunTest, WritesWhereItBeganThoughTheProcessMoves) {
  fs::create_directories(folder_);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  std::string error = error_of_run("run", [&] { fs::current_path("/"); });
  fs::current_path(before);
  EXPECT_EQ(error, "");
  EXPECT_TRUE(fs::exists(at("run") / "checkpoint.h5"));
}

TEST_F(RunTest, CallsBackAfterEachStepAndBeforeEachOutput) {
  const Scene scene =
      small_scene({"time.step=1/32", "time.end=0.125", "output.diagnostics_every=1/32", "output.vesicle_every=1/16",
                   "output.fluid_every=0", "output.checkpoint_every=0.125"});
  SceneSimulation simulation(scene);
  RunOptions options;
  options.directory = at("run");
  options.quiet = true;
  std::string calls;
  options.after_step = [&](const SceneSimulation& now) { calls += " " + std::to_string(now.steps()); };
  options.before_output = [&](const SceneSimulation&, RunOutput output) {
    calls += std::string("dvfc").at(static_cast<std::size_t>(output));
    EXPECT_EQ(fs::exists(at("run") / "checkpoint.h5"), false);  // it is not there before it is written
  };
  EXPECT_EQ(run(simulation, options), RunStatus::completed);
  EXPECT_EQ(calls, "dv 1d 2dv 3d 4dvc");
}

/// What a callback throws ends the run like an error of its own, with a summary that names the last checkpoint.
TEST_F(RunTest, EndsWithWhatACallbackThrows) {
  SceneSimulation simulation(small_scene({"time.end=0.1", "output.checkpoint_every=1/96"}));
  RunOptions options;
  options.directory = at("run");
  options.quiet = true;
  options.after_step = [](const SceneSimulation& now) {
    if (now.steps() == 3) throw SimulationStopped("far enough", "the host program");
  };
  try {
    run(simulation, options);
    FAIL() << "should have stopped";
  } catch (const coupling::SimulationStopped& reason) {
    EXPECT_NE(std::string(reason.what()).find("far enough"), std::string::npos) << reason.what();
  }
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"status\": \"stopped\""), std::string::npos);
  options.directory = at("other");
  options.after_step = {};
  options.before_output = [](const SceneSimulation&, RunOutput) { throw std::out_of_range("of the host"); };
  SceneSimulation another(small_scene({"time.end=0.1"}));
  EXPECT_THROW(run(another, options), std::out_of_range);
}

TEST_F(RunTest, WritesDiagnosticsOfAProgramsOwn) {
  const Scene scene = small_scene({"time.end=0.1"});
  RunOptions options;
  options.directory = at("run");
  options.quiet = true;
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

TEST(ExitCode, IsThatOfMemoryWhereMemoryRanOut) {
  char name[] = "program";
  char* arguments[] = {name, nullptr};
  for (int call = 0; call < 2; ++call)  // a program may be called again
    EXPECT_EQ(exit_code_of([](int, char**) -> int { throw std::bad_alloc(); }, 1, arguments), exit_code::out_of_memory);
}

TEST(MemoryWarning, NamesWhatASceneTakesAndWhatThereIs) {
  EXPECT_EQ(memory_warning(small_scene()), "");
  const std::string warning = memory_warning(small_scene({"domain.cells=2048"}));
  EXPECT_NE(warning.find("this scene takes about"), std::string::npos) << warning;
}

}  // namespace
}  // namespace vesiflow::run
