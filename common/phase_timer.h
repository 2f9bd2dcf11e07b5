#pragma once

#include <chrono>

#include "fluid/phase_account.h"

namespace vesiflow::coupling {

/// Enters an account for its lifetime: one entry, and the wall seconds.
class PhaseTimer {
 public:
  explicit PhaseTimer(fluid::PhaseAccount& account) : account_(account), start_(Clock::now()) { ++account_.entries; }
  ~PhaseTimer() { account_.seconds += std::chrono::duration<double>(Clock::now() - start_).count(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  fluid::PhaseAccount& account_;
  Clock::time_point start_;
};

}  // namespace vesiflow::coupling
