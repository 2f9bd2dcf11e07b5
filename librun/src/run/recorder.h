// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/snapshot_series.h"
#include "run/last_checkpoint.h"
#include "run/results.h"
#include "run/run_folder.h"
#include "run/run_log.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// Writes what a run writes at the intervals of its scene: rows of diagnostics.csv, snapshots, checkpoints. (RunOutput says which there
/// are.)
class Recorder {
 public:
  /// What of a run it works with. All of it outlives the recorder.
  struct Parts {
    SceneSimulation& simulation;
    const RunOptions& options;
    const RunFolder& folder;
    LastCheckpoint& checkpoint;
    RunRecord& record;
  };

  /// Goes on with the files that are in the folder.
  explicit Recorder(const Parts& run);

  /// Writes what is due at the present time; at the end everything that is written at all.
  void write_what_is_due(bool last, RunLog& log);
  /// Drops what was written after the present step. (A run that went on after its last checkpoint has left rows and snapshots that will
  /// be computed again.)
  void rewind();
  /// Brings the lists of the snapshots up to date.
  void list_snapshots();
  /// Whether it is due or not.
  void write_checkpoint();

 private:
  bool wants(double every, bool last) const;
  void announce(RunOutput output) const;
  void write_diagnostics(RunLog& log);
  bool is_spoilt(RunLog& log) const;

  Parts run_;
  DiagnosticsTable table_;
  SnapshotSeries vesicle_snapshots_, fluid_snapshots_;
};

}  // namespace vesiflow::run
