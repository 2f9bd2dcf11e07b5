// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/export.h"

namespace vesiflow::coupling {

/// Parameters ask for something that cannot be done. Each mistake names the parameter (`time.step`,
/// `vesicles.0.radius`), its value and what is allowed; what() says all of them.
class VESIFLOW_COUPLING_EXPORT ParameterError : public std::runtime_error {
 public:
  /// An error of one mistake.
  explicit ParameterError(const std::string& mistake) : ParameterError(std::vector<std::string>{mistake}) {}
  /// An error of several mistakes.
  explicit ParameterError(std::vector<std::string> mistakes)
      : std::runtime_error(joined(mistakes)), mistakes_(std::move(mistakes)) {}
  /// The mistakes, one by one.
  const std::vector<std::string>& mistakes() const { return mistakes_; }

  /// One mistake as it is, several as a numbered list, cut after a screenful.
  static std::string joined(const std::vector<std::string>& mistakes);

 private:
  std::vector<std::string> mistakes_;
};

/// The state stopped being usable: not finite, a limit passed, a marker at a wall. what() says what went wrong,
/// advice() what to change.
class VESIFLOW_COUPLING_EXPORT SimulationStopped : public std::runtime_error {
 public:
  /// \param cause what went wrong: it is what() says.
  /// \param advice_text what to change.
  SimulationStopped(const std::string& cause, std::string advice_text)
      : std::runtime_error(cause), advice_(std::move(advice_text)) {}
  /// What to change.
  const std::string& advice() const { return advice_; }

 private:
  std::string advice_;
};

}  // namespace vesiflow::coupling
