// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>

#include "run/errors.h"
#include "run/run.h"

namespace vesiflow::run {

namespace fs = std::filesystem;

/// A folder of the test's own for runs, which is gone afterwards.
class RunInFolder : public testing::Test {
 protected:
  RunInFolder()
      : folder_(fs::temp_directory_path() / ("vesiflow_run_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~RunInFolder() override { fs::remove_all(folder_); }

  fs::path at(const char* name) const { return folder_ / name; }

  fs::path folder_;
};

/// Without progress.
inline RunOptions options_in(const fs::path& folder) {
  RunOptions options;
  options.directory = folder;
  options.quiet = true;
  return options;
}

inline RunStatus run_scene(const Scene& scene, const fs::path& folder,
                           const std::optional<fs::path>& checkpoint = std::nullopt) {
  SceneSimulation simulation(scene);
  RunOptions options = options_in(folder);
  options.checkpoint = checkpoint;
  return run(simulation, options);
}

/// Calls `harm` after the first step of a run and returns what the run says.
inline std::string error_of_run(const Scene& scene, const fs::path& folder, const std::function<void()>& harm) {
  SceneSimulation simulation(scene);
  RunOptions options = options_in(folder);
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

inline std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace vesiflow::run
