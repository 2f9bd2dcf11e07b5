#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace vesiflow::coupling {

/// The scene, the command line or the checkpoint asks for something that cannot be done. The message names
/// file, line, key, value and what is allowed.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file of results could not be written or read.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The state stopped being usable: not finite, a limit passed, a marker at a wall. `cause` says what went wrong,
/// `advice` what to change.
class SimulationStopped : public std::runtime_error {
 public:
  SimulationStopped(const std::string& cause, std::string advice_text)
      : std::runtime_error(cause), advice_(std::move(advice_text)) {}
  const std::string& advice() const { return advice_; }

 private:
  std::string advice_;
};

}  // namespace vesiflow::coupling
