// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/progress.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// What a run says on standard error while it computes: its progress, and what happens in its steps.
class RunLog {
 public:
  /// \param quiet warnings only
  RunLog(bool quiet, const SceneSimulation& simulation) : quiet_(quiet), progress_(quiet, simulation) {}

  /// After every step.
  void say_step(SceneSimulation& simulation);
  /// Says once that checkpoints wait, as the state may be the start of a blow-up. Not where it is quiet.
  void warn_of_noise(const SceneSimulation& simulation);
  /// Says once, of the vesicle that needs most, that meshes are too coarse for the shapes; not in the first steps, in which a shape that
  /// starts far from rest settles. The warnings at the end say how many they were.
  void warn_of_resolution(SceneSimulation& simulation);
  /// Ends the line of the progress, so that other text can follow.
  void finish() { progress_.finish(); }

 private:
  void say_start(const SceneSimulation& simulation);
  void say_redistributions(const SceneSimulation& simulation);

  bool quiet_;
  bool warned_of_noise_ = false, warned_of_resolution_ = false;
  Progress progress_;
};

}  // namespace vesiflow::run
