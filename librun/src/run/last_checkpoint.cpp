// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/last_checkpoint.h"

#include <spdlog/spdlog.h>

#include <vector>

#include "files/shell_words.h"
#include "run/checkpoint.h"

namespace vesiflow::run {

void LastCheckpoint::restore() {
  if (!options_.checkpoint) return;
  restore_checkpoint(*options_.checkpoint, simulation_);
  path_ = *options_.checkpoint;
}

void LastCheckpoint::forget_what_was_moved() {
  if (options_.checkpoint && !std::filesystem::exists(*options_.checkpoint)) path_.reset();
}

void LastCheckpoint::write(const RunQuality& quality) {
  write_checkpoint(folder_.checkpoint(), simulation_);
  path_ = folder_.named_checkpoint();
  step_ = simulation_.steps();
  errors_ = quality.errors();
}

bool LastCheckpoint::can_go_back() const {
  std::error_code error;
  return std::filesystem::exists(folder_.checkpoint(), error);
}

// The checkpoint may be of longer steps than those that have just failed.
RunRecord::Retry LastCheckpoint::go_back(const coupling::SimulationStopped& reason, RunQuality& quality) {
  RunRecord::Retry retry{simulation_.steps() + 1, simulation_.time(), reason.what(), 0,
                         0.5 * simulation_.scene().time.step};
  simulation_.set_time_step(read_checkpoint_scene(folder_.checkpoint()).time.step);
  restore_checkpoint(folder_.checkpoint(), simulation_);
  simulation_.set_time_step(retry.time_step);
  retry.from_step = step_ = simulation_.steps();
  quality.restore(errors_);
  return retry;
}

bool LastCheckpoint::can_be_continued() const {
  std::error_code error;
  return path_ && std::filesystem::exists(*path_, error);
}

std::string LastCheckpoint::command_to_continue() const {
  std::vector<std::string> words = options_.command;
  words.insert(words.end(), {"--restart", path_->string(), "--out", options_.directory.string()});
  return shell_line(words);
}

}  // namespace vesiflow::run
