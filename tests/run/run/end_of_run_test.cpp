// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// How runs and programs end that cannot go on.
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::end_of_run_test {
namespace {

using coupling::SimulationStopped, coupling::small_scene;

class EndOfRun : public RunInFolder {};

TEST_F(EndOfRun, BlowUpNamesStepTimeCauseAndCheckpoint) {
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

// The reason for which a run stops is said also where its summary cannot be written.
TEST_F(EndOfRun, SaysWhyItStoppedWithoutItsSummaryToo) {
  const Scene scene = small_scene({"membrane.g=15.5", "time.end=20", "output.checkpoint_every=0"});
  const std::string error = error_of_run(scene, at("run"), [&] {
    fs::remove(at("run") / "summary.json");
    fs::create_directories(at("run") / "summary.json" / "in the way");
  });
  EXPECT_NE(error.find("likely cause"), std::string::npos) << error;
}

// What a callback throws ends the run like an error of its own, with a summary that names the last checkpoint.
TEST_F(EndOfRun, EndsWithWhatACallbackThrows) {
  SceneSimulation simulation(small_scene({"time.end=0.1", "output.checkpoint_every=1/96"}));
  RunOptions options = options_in(at("run"));
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

// Whatever it is: the folder does not say "running" for ever, and what was computed between the checkpoints is there.
TEST_F(EndOfRun, KeepsWhatWasComputedWhenACallbackThrowsAnythingElse) {
  SceneSimulation simulation(small_scene({"time.end=0.1", "output.checkpoint_every=1"}));
  RunOptions options = options_in(at("run"));
  options.after_step = [](const SceneSimulation& now) {
    if (now.steps() == 3) throw std::out_of_range("of the host");
  };
  EXPECT_THROW(run(simulation, options), std::out_of_range);
  const std::string summary = text_of(at("run") / "summary.json");
  EXPECT_NE(summary.find("\"status\": \"stopped\""), std::string::npos) << summary;
  EXPECT_NE(summary.find("of the host"), std::string::npos) << summary;
  SceneSimulation again(read_checkpoint_scene(at("run") / "checkpoint.h5"));
  restore_checkpoint(at("run") / "checkpoint.h5", again);
  EXPECT_EQ(again.steps(), 3);
  EXPECT_TRUE(fs::exists(at("run") / report_name));
  EXPECT_FALSE(fs::exists(at("run") / "run.lock"));
}

// The solver is made in the first step: libcoupling's error of a parameter is one of the scene by then too.
TEST_F(EndOfRun, NamesTheSolverThatCannotBeHad) {
  const Scene scene = small_scene({"domain.cells=48", "membrane.g=2", "fluid.viscosity_ratio=5",
                                   "fluid.viscous_treatment=implicit", "fluid.velocity_solver=cholmod"});
  try {
    run_scene(scene, at("run"));
    FAIL() << "should have been refused";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    for (const char* part : {"fluid.velocity_solver: ", "memory_limit"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(ExitCode, IsThatOfMemoryWhereMemoryRanOut) {
  char name[] = "program";
  char* arguments[] = {name, nullptr};
  for (int call = 0; call < 2; ++call)  // a program may be called again
    EXPECT_EQ(exit_code_of([](int, char**) -> int { throw std::bad_alloc(); }, 1, arguments), exit_code::out_of_memory);
}

}  // namespace
}  // namespace vesiflow::run::end_of_run_test
