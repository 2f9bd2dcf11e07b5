#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "check.h"
#include "coupling/checkpoint.h"
#include "coupling/errors.h"

namespace vesiflow::fuzz {

/// A tiny run whose checkpoint the targets damage: made by the library itself, so that the targets follow its format.
class CheckpointCase {
 public:
  explicit CheckpointCase(const std::filesystem::path& scratch)
      : scene_(coupling::parse_scene(text, "scene.toml")), simulation_(scene_) {
    simulation_.step();
    simulation_.step();
    coupling::write_checkpoint(scratch, simulation_);
    std::ifstream stream(scratch, std::ios::binary);
    intact_.assign(std::istreambuf_iterator<char>(stream), {});
  }

  const std::vector<char>& intact() const { return intact_; }

  /// Reads scene and state: a SceneError, or a state from which the next step is made or stopped with a reason. Says whether
  /// the state was taken.
  bool restore(const std::filesystem::path& file) {
    try {
      coupling::read_checkpoint_scene(file);
      coupling::restore_checkpoint(file, simulation_);
    } catch (const coupling::SceneError&) {
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

  coupling::Scene scene_;
  coupling::Simulation simulation_;
  std::vector<char> intact_;
};

}  // namespace vesiflow::fuzz
