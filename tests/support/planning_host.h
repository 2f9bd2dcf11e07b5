// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A host program that is planning a transform of its own.
#pragma once

#include <fftw3.h>
#include <pthread.h>

#include <atomic>
#include <complex>
#include <ctime>
#include <thread>
#include <vector>

class PlanningHost {
 public:
  PlanningHost() : thread_([this] { plan(); }) {
    while (!finished_ && seconds_of(clock_of_thread()) < preparing) std::this_thread::yield();
  }
  ~PlanningHost() {
    if (thread_.joinable()) thread_.join();
  }
  PlanningHost(const PlanningHost&) = delete;
  PlanningHost& operator=(const PlanningHost&) = delete;

  // Processor seconds that the host goes on planning from now on.
  double planning_left() {
    const double now = finished_ ? 0.0 : seconds_of(clock_of_thread());
    thread_.join();
    return now == 0.0 ? 0.0 : end_ - now;
  }

 private:
  static constexpr double preparing = 0.02;  // what comes before the planner takes much less

  void plan() {
    std::vector<std::complex<double>> values(64 * 64);
    auto* const data = reinterpret_cast<fftw_complex*>(values.data());
    fftw_set_timelimit(0.3);  // patient planning of that size takes longer
    const fftw_plan made = fftw_plan_dft_2d(64, 64, data, data, FFTW_FORWARD, FFTW_PATIENT);
    end_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    finished_ = true;
    fftw_set_timelimit(FFTW_NO_TIMELIMIT);
    fftw_destroy_plan(made);
  }

  static double seconds_of(clockid_t clock) {
    timespec time = {};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  clockid_t clock_of_thread() {
    clockid_t clock = 0;
    pthread_getcpuclockid(thread_.native_handle(), &clock);
    return clock;
  }

  double end_ = 0.0;
  std::atomic<bool> finished_{false};
  std::thread thread_;
};
