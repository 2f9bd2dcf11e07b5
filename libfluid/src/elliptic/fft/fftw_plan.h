// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Planning with FFTW.
#pragma once

#include <fftw3.h>

#include <stdexcept>

#include "fftw_planner.h"

namespace vesiflow::fluid {

// Plans are made with FFTW_ESTIMATE and not FFTW_MEASURE: a measured plan depends on the load of the machine, and with
// the plan the order of the additions. This way a restart in another process gives the same bits, and so does every
// thread.
class FftwPlan {
 public:
  // make() calls one of FFTW's planners. Throws std::runtime_error if that makes no plan.
  template <class Make>
  explicit FftwPlan(const Make& make) {
    lock_fftw_planner();
    plan_ = make();
    if (plan_ == nullptr) throw std::runtime_error("transform: FFTW made no plan");
  }
  ~FftwPlan() { fftw_destroy_plan(plan_); }
  FftwPlan(const FftwPlan&) = delete;
  FftwPlan& operator=(const FftwPlan&) = delete;

  fftw_plan get() const { return plan_; }

 private:
  fftw_plan plan_ = nullptr;
};

}  // namespace vesiflow::fluid
