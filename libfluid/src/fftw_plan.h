// Planning with FFTW.
#pragma once

#include <fftw3.h>

#include <mutex>
#include <stdexcept>

namespace vesiflow::fluid {

// FFTW's planner keeps global state: making and destroying plans must not overlap.
inline std::mutex fftw_planner_mutex;

// Plans are made with FFTW_ESTIMATE and not FFTW_MEASURE: a measured plan depends on the load of the machine, and with
// the plan the order of the additions. This way a restart in another process gives the same bits, and so does every
// thread.
class FftwPlan {
 public:
  // make() calls one of FFTW's planners. Throws std::runtime_error if that makes no plan.
  template <class Make>
  explicit FftwPlan(const Make& make) {
    const std::lock_guard lock(fftw_planner_mutex);
    plan_ = make();
    if (plan_ == nullptr) throw std::runtime_error("transform: FFTW made no plan");
  }
  ~FftwPlan() {
    const std::lock_guard lock(fftw_planner_mutex);
    fftw_destroy_plan(plan_);
  }
  FftwPlan(const FftwPlan&) = delete;
  FftwPlan& operator=(const FftwPlan&) = delete;

  fftw_plan get() const { return plan_; }

 private:
  fftw_plan plan_ = nullptr;
};

}  // namespace vesiflow::fluid
