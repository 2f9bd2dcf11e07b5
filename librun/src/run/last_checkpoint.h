// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "run/errors.h"
#include "run/results.h"
#include "run/run_folder.h"
#include "run/run_quality.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// The last good checkpoint of a run: the one that it continues, then those that it writes, each in the place of the one before. The run
/// goes back to it, and another run can go on from it.
class LastCheckpoint {
 public:
  /// All of them outlive this.
  LastCheckpoint(SceneSimulation& simulation, const RunOptions& options, const RunFolder& folder)
      : simulation_(simulation), options_(options), folder_(folder) {}

  /// Continues the checkpoint that the options name, if they do.
  void restore();
  /// Notes that the folder's checkpoint is of the present state.
  void mark_current() { step_ = simulation_.steps(); }
  /// Forgets the checkpoint that was continued if it is no longer there.
  void forget_what_was_moved();

  /// Writes the state of the simulation into the folder.
  void write(const RunQuality& quality);
  /// Step of what is in the folder's checkpoint; -1 if it has none of this run.
  long step() const { return step_; }

  /// Whether there is a checkpoint in the folder to go back to.
  bool can_go_back() const;
  /// Takes the simulation and its errors back there, with half the step of the one that failed.
  /// \returns what the summary says of it
  RunRecord::Retry go_back(const coupling::SimulationStopped& reason, RunQuality& quality);

  /// Where it is, for people.
  std::string description() const { return path_ ? path_->string() : "none yet"; }
  /// Whether another run can go on from it, and the command that does so.
  bool can_be_continued() const;
  std::string command_to_continue() const;

 private:
  SceneSimulation& simulation_;
  const RunOptions& options_;
  const RunFolder& folder_;
  std::optional<std::filesystem::path> path_;
  long step_ = -1;
  RunQuality::Errors errors_;
};

}  // namespace vesiflow::run
