// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/run.h"
#include "run/run_quality.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// What summary.json says of the run besides the state of the simulation.
struct RunRecord {
  /// A step that could not be taken, and with what the run went on.
  struct Retry {
    long step;    ///< that failed
    double time;  ///< before it
    std::string cause;
    long from_step;    ///< of the checkpoint
    double time_step;  ///< from there on
  };

  explicit RunRecord(const Scene& scene) : quality(scene) {}

  std::string status = "running";
  std::optional<std::string> stop_reason;
  std::vector<Retry> retries;
  RunQuality quality;
  long steps_taken = 0;       ///< by this process
  long interface_passes = 0;  ///< solves in these steps, see coupling::Simulation::interface_passes()
  fluid::PhaseAccount wall;   ///< of these steps, output included
  fluid::PhaseAccount output_table, output_vesicle, output_fluid, output_checkpoint;
};

/// Removes what a kill within a write has left of a file.
void remove_leftovers(const std::filesystem::path& directory);

/// Moves the results of an earlier run to previous_N/. Returns where, or nothing if there were none.
std::optional<std::filesystem::path> move_earlier_results(const std::filesystem::path& directory);

void write_summary(const std::filesystem::path& directory, const RunOptions& options, SceneSimulation& simulation,
                   RunRecord& record);

/// Whether the summary in the directory says that a run has been completed with so many steps.
bool is_completed(const std::filesystem::path& directory, long steps);

/// diagnostics.csv: one whole line per vesicle and time, appended at once. What a kill has left of a line is removed.
class DiagnosticsTable {
 public:
  /// \throws SceneError for a name of `own` that is no name of a column, or is there already, and for a table with other columns
  DiagnosticsTable(const std::filesystem::path& directory, std::size_t vesicles, std::vector<OwnDiagnostic> own);
  /// A row for each vesicle, of what measure() and coupling::nearest_distances() have given.
  void write(SceneSimulation& simulation, std::span<const vesicle::Diagnostics> all, std::span<const double> distances);
  /// Removes the rows after `step`: a restarted run writes them again.
  void rewind(long step);
  /// What a checkpoint counts on must not be lost with the power.
  void flush_to_disk() const;
  long last_step() const { return last_step_; }

 private:
  std::filesystem::path file_;
  std::vector<OwnDiagnostic> own_;
  std::string columns_;
  long last_step_ = -1;
};

}  // namespace vesiflow::run
