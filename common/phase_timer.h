// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace vesiflow {

/// Enters an account for its lifetime: one entry, and the wall seconds. The account is fluid::PhaseAccount, or
/// another with `entries` and `seconds`.
template <typename Account>
class PhaseTimer {
 public:
  explicit PhaseTimer(Account& account) : account_(account), start_(Clock::now()) { ++account_.entries; }
  ~PhaseTimer() { account_.seconds += std::chrono::duration<double>(Clock::now() - start_).count(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Account& account_;
  Clock::time_point start_;
};

}  // namespace vesiflow
