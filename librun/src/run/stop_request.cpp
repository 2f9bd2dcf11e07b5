// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/stop_request.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>

namespace vesiflow::run {
namespace {

// The signal that has come, in the lowest byte (0 if none has), and above it the second in which it came. It may be set in a signal
// handler, in two threads at once: in one word, so that nobody sees a signal with the second of another.
std::atomic<std::int64_t> seen{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);
constexpr int signal_bits = 8;

int signal_in(std::int64_t word) {
  return static_cast<int>(word & ((1 << signal_bits) - 1));
}

// Twice within a second or two is once: timeout(1) and closing terminals signal a process and its group.
void request(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t before = seen;
  if (signal_in(before) != signal) {
    seen = static_cast<std::int64_t>(now.tv_sec) << signal_bits | signal;
  } else if (now.tv_sec > (before >> signal_bits) + 1) {
    ::signal(signal, SIG_DFL);
    raise(signal);
  }
}

struct Handled {
  int signal;
  bool always;  ///< else only where nobody has said what to do with it
  struct sigaction before;
};

std::mutex mutex;  // over what follows
int alive = 0;
std::array<Handled, 6> handled{Handled{SIGINT, true, {}},   Handled{SIGTERM, true, {}},  Handled{SIGHUP, false, {}},
                               Handled{SIGUSR1, false, {}}, Handled{SIGUSR2, false, {}}, Handled{SIGPIPE, false, {}}};

void set(Handled& entry) {
  sigaction(entry.signal, nullptr, &entry.before);
  if (!entry.always && ((entry.before.sa_flags & SA_SIGINFO) != 0 || entry.before.sa_handler != SIG_DFL)) return;
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  action.sa_handler = entry.signal == SIGPIPE ? SIG_IGN : request;
  action.sa_flags = SA_RESTART;
  sigaction(entry.signal, &action, nullptr);
}

}  // namespace

StopRequest::StopRequest() {
  const std::lock_guard guard(mutex);
  if (alive++ > 0) return;
  seen = 0;
  for (Handled& entry : handled) set(entry);
}

StopRequest::~StopRequest() {
  const std::lock_guard guard(mutex);
  if (--alive > 0) return;
  for (const Handled& entry : handled) sigaction(entry.signal, &entry.before, nullptr);
}

int StopRequest::signal() {
  return signal_in(seen);
}

}  // namespace vesiflow::run
