// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "short_waits.h"

#include <dlfcn.h>
#include <omp.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <future>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "standard_streams.h"

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

// Threads that do nothing, all alive together until the object goes.
class Crowd {
 public:
  // Whether that many threads can live beside those there are. Of POSIX: a thread that cannot be started is no exception.
  bool admits(int threads) {
    for (int i = 0; i < threads; ++i) {
      pthread_t thread;
      if (pthread_create(&thread, nullptr, wait, this) != 0) return false;
      members_.push_back(thread);
    }
    return true;
  }
  ~Crowd() {
    end_.set_value();
    for (const pthread_t thread : members_) pthread_join(thread, nullptr);
  }

 private:
  static void* wait(void* crowd) {
    std::shared_future<void>(static_cast<Crowd*>(crowd)->ended_).wait();
    return nullptr;
  }

  std::promise<void> end_;
  const std::shared_future<void> ended_ = end_.get_future().share();
  std::vector<pthread_t> members_;
};

// A sleeper must not wake to code that is gone, where a host closes the library that this is in: setuid() wakes all threads.
void keep_loaded() {
  Dl_info here;
  if (dladdr(reinterpret_cast<void*>(&keep_loaded), &here) != 0)
    dlopen(here.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
}

// A team of as many threads, that count and then sleep for good. Whether they could be started.
bool park(int threads) try {
  keep_loaded();
  std::promise<void> counted;
  std::future<void> done = counted.get_future();
  std::thread([threads, counted = std::move(counted)]() mutable {
    int entered = 0;
#pragma omp parallel num_threads(threads)
#pragma omp atomic
    ++entered;
    counted.set_value();
    for (;;) pause();
  }).detach();
  done.wait();
  return true;
} catch (const std::system_error&) {  // another program was faster
  return false;
}

// The threads that the runtime counts for this program: the teams of the host, and ours.
class Parking {
 public:
  // Makes teams of `threads` more than the cores. Smaller teams later need more, larger ones nothing.
  void make_room_beside(int threads) {
    if (threads >= served_) return;
    const std::lock_guard<std::mutex> one_at_a_time(busy_);
    if (threads >= served_) return;
    // A team that the host starts counts with all its threads, a parked one with all but its first.
    const int missing = std::max(1, omp_get_num_procs() - threads + 1) - counted_;
    if (missing > 0) add(missing, threads);
    served_ = threads;  // last: who comes meanwhile waits, as regions that start threads do not go with the trial
  }

 private:
  static constexpr int most_counted = 15;
  static constexpr const char* advice =
      "vesiflow: OpenMP's threads will spin while they wait: what prevents it takes more threads than are reasonable "
      "here, or than a limit (ulimit -u) allows\n"
      "  where other programs use the cores too, OMP_WAIT_POLICY=passive in the environment makes steps faster\n";

  // The runtime ends the process where it cannot start a thread, so those that follow are tried first: the parked team, and
  // all of the host's team but the calling thread.
  static bool can_start(int threads) { return Crowd().admits(threads); }

  void add(int missing, int threads) {
    const NoSignals inherited;
    if (counted_ + missing <= most_counted && can_start(missing + threads) && park(missing + 1)) {
      counted_ += missing;
    } else if (!has_warned_) {
      say(advice);
      has_warned_ = true;
    }
  }

  std::mutex busy_;
  std::atomic<int> served_ = std::numeric_limits<int>::max();  // the least team that there is room for, or can be none
  int counted_ = 0;
  bool has_warned_ = false;
};

}  // namespace

void keep_waits_short() {
  if (omp_get_max_threads() == 1) return;
  static const bool chosen = user_has_chosen();
  if (chosen) return;
  if (kmp_set_blocktime != nullptr) {  // holds for the regions of the calling thread
    [[maybe_unused]] thread_local const bool short_here = (kmp_set_blocktime(0), true);
  } else {
    static Parking parking;
    parking.make_room_beside(omp_get_max_threads());
  }
}

}  // namespace vesiflow
