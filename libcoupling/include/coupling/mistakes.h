// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupling/errors.h"
#include "coupling/export.h"

namespace vesiflow::coupling {

/// What is wrong with parameters, gathered so that all of it is said at once.
class VESIFLOW_COUPLING_EXPORT Mistakes {
 public:
  /// Adds a mistake, in a sentence; once, however often it is found.
  void add(std::string mistake);
  /// Adds the mistakes of the ParameterError that `check` throws. Returns whether it threw none.
  bool gather(const std::function<void()>& check);

  bool empty() const { return all_.empty(); }                   ///< whether none was found
  const std::vector<std::string>& all() const { return all_; }  ///< in the order in which they were found

  /// Ends the gathering.
  /// \throws ParameterError of all mistakes, unless there are none.
  void refuse() const;

 private:
  std::vector<std::string> all_;
};

}  // namespace vesiflow::coupling
