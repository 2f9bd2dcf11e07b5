// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "run/scene_simulation.h"

namespace vesiflow::run {

/// Shows how far a run is on standard error: a bar that renews itself on a terminal, a line every few seconds on a
/// pipe, nothing when quiet.
class Progress {
 public:
  Progress(bool quiet, const SceneSimulation& simulation);
  /// Called after every step; prints only when it is time to.
  void update(SceneSimulation& simulation);
  /// Ends the bar's line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void show(SceneSimulation& simulation, Clock::time_point now);

  bool quiet_;
  bool terminal_;
  bool bar_shown_ = false;
  long first_step_;
  double first_time_;
  Clock::time_point start_, last_shown_;
};

}  // namespace vesiflow::run
