// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The files of a run that goes on from a checkpoint.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::restart_files_test {
namespace {

using coupling::small_scene, coupling::three_vesicles;

class RestartFiles : public RunInFolder {};

// Nothing is written again, and nothing moved aside; a run whose summary does not say so yet ends once more.
TEST_F(RestartFiles, OfACompleteRunChangesNothing) {
  const Scene scene = small_scene({"time.end=0.03"});
  run_scene(scene, at("run"));
  const std::string summary = text_of(at("run") / "summary.json");
  EXPECT_EQ(run_scene(scene, at("run"), at("run") / "checkpoint.h5"), RunStatus::completed);
  EXPECT_EQ(text_of(at("run") / "summary.json"), summary);
  std::ofstream(at("run") / "summary.json") << "{}";
  EXPECT_EQ(run_scene(scene, at("run"), at("run") / "checkpoint.h5"), RunStatus::completed);
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"completed\""), std::string::npos);
}

TEST_F(RestartFiles, ContinuesThem) {
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
TEST_F(RestartFiles, DropsWhatWasWrittenAfterTheCheckpoint) {
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

// The list of snapshots for ParaView never names one that is not in the file: a restart takes both back, though its end writes none.
TEST_F(RestartFiles, DropsSnapshotsFromTheListToo) {
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

// A kill within the write of a row leaves a part of it.
TEST_F(RestartFiles, RemovesATornRowOfTheTable) {
  const std::string cadence = "output.diagnostics_every=0.125";
  run_scene(small_scene({cadence}), at("whole"));
  run_scene(small_scene({cadence, "time.end=0.25"}), at("parts"));
  std::ofstream(at("parts") / "diagnostics.csv", std::ios::app) << "36,0.3";
  run_scene(small_scene({cadence}), at("parts"), at("parts") / "checkpoint.h5");
  EXPECT_EQ(text_of(at("whole") / "diagnostics.csv"), text_of(at("parts") / "diagnostics.csv"));
}

TEST_F(RestartFiles, RefusesUnusableCheckpointsAndTouchesNothing) {
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

TEST_F(RestartFiles, RefusesAVesicleWithAnotherPropertyOfItsOwn) {
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

}  // namespace
}  // namespace vesiflow::run::restart_files_test
