#include "stop_request.h"

#include <atomic>
#include <csignal>

namespace vesiflow::coupling {
namespace {

std::atomic<int> requested{0};
static_assert(std::atomic<int>::is_always_lock_free);  // may be set in a signal handler

void request(int signal) {
  requested = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

StopRequest::StopRequest() {
  requested = 0;
  old_interrupt_ = std::signal(SIGINT, request);
  old_terminate_ = std::signal(SIGTERM, request);
}

StopRequest::~StopRequest() {
  std::signal(SIGINT, old_interrupt_);
  std::signal(SIGTERM, old_terminate_);
}

int StopRequest::signal() {
  return requested;
}

}  // namespace vesiflow::coupling
