// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "run/run.h"

namespace vesiflow::run {

/// What is said of a run that has ended so, and how programs end then.
struct RunEnd {
  RunStatus status;
  int signal;         ///< that asked for it; 0 if none did
  const char* name;   ///< in summary.json
  const char* cause;  ///< for people
  int exit_code;
};

const RunEnd& end_of(RunStatus status);

/// How a run ends that gets the signal; nothing if it is not one of those.
std::optional<RunStatus> status_of_signal(int signal);

}  // namespace vesiflow::run
