// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "run/export.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// What a run writes at the intervals of its scene.
enum class RunOutput {
  diagnostics,       ///< a row of diagnostics.csv
  vesicle_snapshot,  ///< a snapshot of the membranes
  fluid_snapshot,    ///< a snapshot of the fluid
  checkpoint         ///< the checkpoint
};

/// A number of a program's own, of each vesicle: a column of diagnostics.csv after those of docs/results.md. What is
/// not finite is left empty.
struct OwnDiagnostic {
  std::string name;  ///< of the column: letters, digits and underscores, and none that is there already
  std::function<double(SceneSimulation& simulation, std::size_t vesicle)> value;  ///< the number, of one vesicle
};

/// Where and how a simulation is run to its end.
struct RunOptions {
  std::string program = "vesiflow";                                ///< written into summary.json
  std::string scene_file = "";                                     ///< written into summary.json
  std::filesystem::path directory = "out";                         ///< of the results, docs/results.md
  std::optional<std::filesystem::path> checkpoint = std::nullopt;  ///< continue from it

  /// Or start from the end of this run, see start_from().
  std::optional<std::filesystem::path> start_from = std::nullopt;
  bool quiet = false;  ///< no progress

  /// The program and the options to keep, as words. A run that ends early says this command with what continues it:
  /// --restart CHECKPOINT --out DIRECTORY. Where it is empty, only the checkpoint is named.
  std::vector<std::string> command = {};
  std::vector<OwnDiagnostic> diagnostics = {};  ///< numbers of the program's own

  /// Called after each step with the state that it has led to, before anything of that state is written. It is not
  /// called before the first step, nor for a step that could not be taken.
  std::function<void(const SceneSimulation&)> after_step = {};
  /// Called before each output that is due, those at the start and at the end included, right before it is measured and
  /// written. What either of the two throws ends the run as if the run itself had thrown it. Both are called in the
  /// thread of run().
  std::function<void(const SceneSimulation&, RunOutput)> before_output = {};
};

/// How a run has ended.
enum class RunStatus {
  completed,      ///< at time.end
  interrupted,    ///< by Ctrl-C (SIGINT)
  terminated,     ///< by SIGTERM
  hung_up,        ///< by SIGHUP
  user_signal_1,  ///< by SIGUSR1
  user_signal_2,  ///< by SIGUSR2
  out_of_time     ///< at limits.wall_time
};

/// Runs `simulation` to the end of its scene: steps, progress, diagnostics, snapshots, checkpoints, summary. Results
/// already in the directory are moved aside, or continued when the checkpoint is the directory's own. While it runs,
/// the directory is its alone: another run is refused. The signals of RunStatus and limits.wall_time end the run after
/// the step under way, with a checkpoint (unless output.checkpoint_every is 0), and it says how to go on; SIGHUP,
/// SIGUSR1 and SIGUSR2 only where the host program neither handles nor ignores them. With limits.on_blowup =
/// "reduce_step" a step that cannot be taken sends the run back to its last checkpoint, from which it goes on with half
/// the step. A run that starts from another one keeps its start in start.h5, a checkpoint from which it can be
/// repeated.
/// \throws SceneError for a checkpoint of another scene, a run to start from that does not fit, or a solver that cannot be
/// had.
/// \throws FileError when a file cannot be read or written, or another run has the directory.
/// \throws coupling::SimulationStopped with step, time, cause and last checkpoint in its message when the run cannot go
/// on.
/// \throws what a function of the program throws, such as options.after_step. The summary then says "stopped" and why; where it was thrown between
/// two steps the last one has a checkpoint.
VESIFLOW_RUN_EXPORT RunStatus run(SceneSimulation& simulation, const RunOptions& options);

/// What summary.json calls it.
VESIFLOW_RUN_EXPORT const char* name_of(RunStatus status);

/// Exit codes of programs, documented in docs/results.md.
namespace exit_code {
inline constexpr int success = 0,  ///< all went well
    internal_error = 1,            ///< an error that is none of the others
    bad_input = 2,                 ///< the command line, the scene or the checkpoint asks for what cannot be done
    stopped = 3,                   ///< the simulation cannot go on
    file_error = 4,                ///< a file could not be read or written
    out_of_memory = 5,             ///< there is not enough memory
    out_of_time = 6,               ///< limits.wall_time has passed
    hung_up = 129,                 ///< 128 + SIGHUP
    interrupted = 130,             ///< 128 + SIGINT
    user_signal_1 = 138,           ///< 128 + SIGUSR1
    user_signal_2 = 140,           ///< 128 + SIGUSR2
    terminated = 143;              ///< 128 + SIGTERM

/// Exit code of a run that has ended so.
VESIFLOW_RUN_EXPORT int of(RunStatus status);
}  // namespace exit_code

/// Calls `program` and turns what it throws into a message on standard error and an exit code. Before, for the whole
/// process: standard streams that are closed become /dev/null, and SIGPIPE and SIGXFSZ are ignored (writing fails
/// instead).
VESIFLOW_RUN_EXPORT int exit_code_of(int (*program)(int argc, char** argv), int argc, char** argv);

}  // namespace vesiflow::run
