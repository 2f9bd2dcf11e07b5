// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

#include "check.h"
#include "run/checkpoint.h"
#include "run/errors.h"

namespace vesiflow::fuzz {

inline std::vector<char> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A tiny run of two steps, whose state the targets damage.
class Run {
 public:
  Run() : scene_(run::parse_scene(text, "scene.toml")), simulation_(scene_) {
    simulation_.step();
    simulation_.step();
    state_.emplace(simulation_.state());
  }

  run::SceneSimulation& simulation() { return simulation_; }

  coupling::SimulationState state() {
    simulation_.restore(*state_);
    return simulation_.state();
  }

  /// Whether the state was taken; then also the next step is made, or stopped with a reason.
  bool restore(const coupling::SimulationState& state) {
    try {
      simulation_.restore(state);
    } catch (const std::invalid_argument&) {
      return false;
    } catch (const std::domain_error&) {
      return false;
    } catch (const coupling::SimulationStopped&) {
      return false;
    }
    try {
      simulation_.step();
    } catch (const coupling::SimulationStopped&) {
    }
    return true;
  }

 private:
  static constexpr const char* text = R"(
[domain]
lower = [-2, -2, -2]
upper = [2, 2, 2]
cells = [12, 12, 12]
periodic = [true, true, false]
[membrane]
g = 2
integral_rate = 0
[mesh]
latitudes = 8
tangential_degrees = 8
[time]
adaptive = true
step = 0.01
[[vesicles]]
shape = "harmonics"
harmonics = [[2, 0, 0.1]]
radius = 0.8
)";

  run::Scene scene_;
  run::SceneSimulation simulation_;
  std::optional<coupling::SimulationState> state_;
};

/// Its checkpoint: made by the library itself, so that the targets follow its format.
class CheckpointCase {
 public:
  explicit CheckpointCase(const std::filesystem::path& scratch) : scratch_(scratch) {
    run::write_checkpoint(scratch, run_.simulation());
    intact_ = bytes_of(scratch);
  }

  const std::vector<char>& intact() const { return intact_; }

  /// Refused by a SceneError, or read as what was written. Says whether it was taken.
  bool restore(const std::filesystem::path& file) {
    try {
      run::read_checkpoint_scene(file);
      run::restore_checkpoint(file, run_.simulation());
    } catch (const run::SceneError&) {
      return false;
    }
    run::write_checkpoint(scratch_, run_.simulation());
    check(bytes_of(scratch_) == intact_, "a checkpoint that is not refused is restored to what was written");
    return true;
  }

 private:
  Run run_;
  std::filesystem::path scratch_;
  std::vector<char> intact_;
};

}  // namespace vesiflow::fuzz
