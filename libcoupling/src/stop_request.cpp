#include "stop_request.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <mutex>

namespace vesiflow::coupling {
namespace {

// May be set in a signal handler.
std::atomic<int> requested{0};
std::atomic<time_t> requested_at{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<time_t>::is_always_lock_free);

// Twice within a second or two is once: timeout(1) and closing terminals signal a process and its group.
void request(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (requested.exchange(signal) != signal) {
    requested_at = now.tv_sec;
  } else if (now.tv_sec > requested_at + 1) {
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
  requested = 0;
  for (Handled& entry : handled) set(entry);
}

StopRequest::~StopRequest() {
  const std::lock_guard guard(mutex);
  if (--alive > 0) return;
  for (const Handled& entry : handled) sigaction(entry.signal, &entry.before, nullptr);
}

int StopRequest::signal() {
  return requested;
}

}  // namespace vesiflow::coupling
