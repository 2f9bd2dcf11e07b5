#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "coupling/simulation.h"

namespace vesiflow::coupling {

/// Where and how a simulation is run to its end.
struct RunOptions {
  std::string program = "vesiflow";                 ///< written into summary.json
  std::string scene_file;                           ///< written into summary.json
  std::filesystem::path directory = "out";          ///< of the results, docs/results.md
  std::optional<std::filesystem::path> checkpoint;  ///< continue from it
  bool quiet = false;                               ///< no progress
};

enum class RunStatus { completed, interrupted };

/// Runs `simulation` to the end of its scene: steps, progress, diagnostics, snapshots, checkpoints, summary. Results
/// already in the directory are moved aside, or continued when the checkpoint is the directory's own. Ctrl-C and
/// SIGTERM end the run after the step under way, with a checkpoint.
/// \throws SceneError for a checkpoint of another scene; FileError when a file cannot be read or written;
/// SimulationStopped, with step, time, cause and last checkpoint in its message, when the run cannot go on
RunStatus run(Simulation& simulation, const RunOptions& options);

/// Exit codes of programs, documented in docs/results.md.
namespace exit_code {
inline constexpr int success = 0, internal_error = 1, bad_input = 2, stopped = 3, file_error = 4, out_of_memory = 5,
                     interrupted = 130;
}

/// Calls `program` and turns what it throws into a message on standard error and an exit code.
int exit_code_of(int (*program)(int argc, char** argv), int argc, char** argv);

}  // namespace vesiflow::coupling
