#include "short_waits.h"

#include <omp.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <future>
#include <system_error>
#include <thread>

extern "C" void kmp_set_blocktime(int milliseconds) __attribute__((weak));  // of LLVM's runtime

namespace vesiflow {
namespace {

bool user_has_chosen() {
  for (const char* name : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "KMP_BLOCKTIME"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

// Signals that the process gets are for the threads of the host.
class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~NoSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_;
};

// As many threads as make a team of `threads` more than the cores. They sleep for good, all signals blocked. Whether they could
// be started.
bool park_beside(int threads) try {
  const int parked = std::max(2, omp_get_num_procs() - threads + 2);
  std::promise<void> counted;
  std::future<void> done = counted.get_future();
  const NoSignals inherited;
  std::thread([parked, counted = std::move(counted)]() mutable {
    int entered = 0;
#pragma omp parallel num_threads(parked)
#pragma omp atomic
    ++entered;
    counted.set_value();
    for (;;) pause();
  }).detach();
  done.wait();
  return true;
} catch (const std::system_error&) {  // no room for another thread, as the regions will find
  return false;
}

}  // namespace

void keep_waits_short() {
  if (omp_get_max_threads() == 1) return;
  static const bool chosen = user_has_chosen();
  if (chosen) return;
  if (kmp_set_blocktime != nullptr) {  // holds for the regions of the calling thread
    [[maybe_unused]] thread_local const bool short_here = (kmp_set_blocktime(0), true);
  } else {
    [[maybe_unused]] static const bool parked = park_beside(omp_get_max_threads());
  }
}

}  // namespace vesiflow
