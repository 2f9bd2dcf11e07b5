// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Waiting threads sleep without the environment saying so.
#include "short_waits.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <thread>

namespace {

constexpr int waits = 5;

// Processor seconds that a thread takes to wait 20 ms for another one, several times; the least of three attempts.
double cost_of_waiting() {
  omp_set_num_threads(2);
  vesiflow::keep_waits_short();
  double least = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 3; ++attempt) {
    const std::clock_t start = std::clock();
    for (int i = 0; i < waits; ++i) {
#pragma omp parallel num_threads(2)
      if (omp_get_thread_num() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

// Takes a variable out of the environment for its lifetime.
class Without {
 public:
  explicit Without(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) value_ = value, unsetenv(name);
  }
  ~Without() {
    if (!value_.empty()) setenv(name_, value_.c_str(), 1);
  }
  Without(const Without&) = delete;
  Without& operator=(const Without&) = delete;

 private:
  const char* name_;
  std::string value_;
};

}  // namespace

// In a process of its own, as the runtime reads the environment once. Left to itself, GCC's spins for 10 ms each time; with the
// environment's word or ours a wait takes 0.05 ms.
TEST(ShortWaits, CostNoTimeOfProcessors) {
  const Without policy("OMP_WAIT_POLICY"), spins("GOMP_SPINCOUNT"), block("KMP_BLOCKTIME");
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const double seconds = cost_of_waiting();
        std::fprintf(stderr, "%g s for %d waits\n", seconds, waits);
        std::exit(seconds < waits * 1e-3 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}
