// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The folder of a run, which is its alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "files/folder_lock.h"
#include "run/errors.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::folder_of_run_test {
namespace {

using coupling::small_scene, coupling::three_vesicles;

class FolderOfRun : public RunInFolder {
 protected:
  const Scene short_scene_ = small_scene({"time.end=0.1", "output.diagnostics_every=1/96"});
};

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

TEST_F(FolderOfRun, RefusesAFolderThatCannotBeWritten) {
  fs::create_directories(folder_);
  std::ofstream(at("file")) << "in the way";
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("file") / "run"), FileError);
  EXPECT_EQ(text_of(at("file")), "in the way");
}

TEST_F(FolderOfRun, ASecondRunInTheSameFolderIsRefusedAndTouchesNothing) {
  run_scene(small_scene({"time.end=0.05"}), at("run"));
  std::ofstream(at("run") / "fluid.h5.part") << "what the first run is writing";
  const FolderLock of_the_first_run(at("run"));
  const auto before = contents_of(at("run"));
  EXPECT_THROW(run_scene(small_scene({"time.end=0.05"}), at("run")), FileError);
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("run"), at("run") / "checkpoint.h5"), FileError);
  EXPECT_EQ(contents_of(at("run")), before);
}

// A checkpoint that another run is writing is not read: which one it is would be known only afterwards.
TEST_F(FolderOfRun, WhatAnotherRunHasIsNotEvenRead) {
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

TEST_F(FolderOfRun, RefusesSnapshotsThatCannotBeRead) {
  const Scene scene = small_scene({"time.end=0.05"});
  run_scene(scene, at("run"));
  fs::remove_all(at("run") / "snapshots");
  std::ofstream(at("run") / "snapshots") << "not a folder";
  EXPECT_THROW(run_scene(small_scene({"time.end=0.1"}), at("run"), at("run") / "checkpoint.h5"), FileError);
}

TEST_F(FolderOfRun, StopsWhereAnotherRunHasTakenItsFolder) {
  const std::string error = error_of_run(short_scene_, at("run"), [&] {
    std::string lock = text_of(at("run") / "run.lock");
    lock.insert(lock.find("since = ") + 8, "later than ");
    std::ofstream(at("run") / "lock") << lock;
    fs::rename(at("run") / "lock", at("run") / "run.lock");
  });
  EXPECT_NE(error.find("in use by another run"), std::string::npos) << error;
  EXPECT_TRUE(fs::exists(at("run") / "run.lock"));
  EXPECT_NE(text_of(at("run") / "summary.json").find("\"status\": \"running\""), std::string::npos);
}

TEST_F(FolderOfRun, StopsWhereItsFolderIsRemoved) {
  const std::string error = error_of_run(short_scene_, at("run"), [&] { fs::rename(at("run"), at("elsewhere")); });
  EXPECT_NE(error.find("No such file or directory"), std::string::npos) << error;
  EXPECT_FALSE(fs::exists(at("run")));
}

TEST_F(FolderOfRun, WritesWhereItBeganThoughTheProcessMoves) {
  fs::create_directories(folder_);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const std::string error = error_of_run(short_scene_, "run", [&] { fs::current_path("/"); });
  fs::current_path(before);
  EXPECT_EQ(error, "");
  EXPECT_TRUE(fs::exists(at("run") / "checkpoint.h5"));
}

}  // namespace
}  // namespace vesiflow::run::folder_of_run_test
