// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_status.h"

#include <algorithm>
#include <array>
#include <csignal>

namespace vesiflow::run {
namespace {

constexpr std::array ends{
    RunEnd{RunStatus::completed, 0, "completed", "completed", exit_code::success},
    RunEnd{RunStatus::interrupted, SIGINT, "interrupted", "interrupted (SIGINT)", exit_code::interrupted},
    RunEnd{RunStatus::terminated, SIGTERM, "terminated", "terminated (SIGTERM)", exit_code::terminated},
    RunEnd{RunStatus::hung_up, SIGHUP, "hung up", "hung up (SIGHUP)", exit_code::hung_up},
    RunEnd{RunStatus::user_signal_1, SIGUSR1, "user signal 1", "told to end (SIGUSR1)", exit_code::user_signal_1},
    RunEnd{RunStatus::user_signal_2, SIGUSR2, "user signal 2", "told to end (SIGUSR2)", exit_code::user_signal_2},
    RunEnd{RunStatus::out_of_time, 0, "out of time", "out of time (limits.wall_time)", exit_code::out_of_time},
};

}  // namespace

const RunEnd& end_of(RunStatus status) {
  return *std::ranges::find(ends, status, &RunEnd::status);
}

const char* name_of(RunStatus status) {
  return end_of(status).name;
}

std::optional<RunStatus> status_of_signal(int signal) {
  if (signal == 0) return std::nullopt;
  const auto* const end = std::ranges::find(ends, signal, &RunEnd::signal);
  return end == ends.end() ? std::nullopt : std::optional(end->status);
}

}  // namespace vesiflow::run
