// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/arkode_integrator.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "motion/constants.h"
#include "sundials_handles.h"

namespace vesiflow::coupling {
namespace {

// Every step is a problem of its own, from time 0 to dt: nothing is remembered from one to the next, so that a
// continued run repeats the uninterrupted one bit for bit.
class Arkode final : public MarkerIntegrator {
 public:
  Arkode(std::size_t size, const MarkerTolerances& tolerances)
      : context_(make_sundials_context()),
        state_(make_sundials_vector(size, context_)),
        rate_([this](double time, std::span<const double> state, std::span<double> velocity) {
          (*velocity_)(std::min(1.0, time / dt_), state, velocity);
        }) {
    N_VConst(0.0, state_);
    memory_.reset(ERKStepCreate(Rate::call, 0.0, state_, context_));
    if (!memory_) throw std::bad_alloc();
    check(ERKStepSetErrHandlerFn(memory_.get(), SundialsMessage::keep, &message_));
    check(ERKStepSetUserData(memory_.get(), &rate_));
    check(ERKStepSetOrder(memory_.get(), constants::order_of_arkode));
    check(ERKStepSStolerances(memory_.get(), tolerances.relative, tolerances.absolute));
  }

  void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) override {
    velocity_ = &velocity;
    dt_ = dt;
    message_ = {};
    std::ranges::copy(state, values(state_).begin());
    check(ERKStepReInit(memory_.get(), Rate::call, 0.0, state_));
    // The whole step, if the tolerance allows it; and no evaluation beyond its end, where no fluid velocity is known.
    check(ERKStepSetInitStep(memory_.get(), dt));
    check(ERKStepSetStopTime(memory_.get(), dt));
    double reached = 0.0;
    const int flag = ERKStepEvolve(memory_.get(), dt, state_, &reached, ARK_NORMAL);
    count();
    rate_.rethrow();
    check(flag);
    std::ranges::copy(values(state_), state.begin());
  }

  MarkerStatistics statistics() const override { return statistics_; }

 private:
  using Rate = SundialsFunction<double>;

  void check(int flag) const {
    if (flag >= 0) return;
    throw std::domain_error("arkode: " + take_name(ERKStepGetReturnFlagName(flag)) +
                            (message_.text.empty() ? "" : ": " + message_.text));
  }

  void count() {
    long steps = 0, rejected = 0, evaluations = 0;
    ERKStepGetNumSteps(memory_.get(), &steps);
    ERKStepGetNumErrTestFails(memory_.get(), &rejected);
    ERKStepGetNumRhsEvals(memory_.get(), &evaluations);
    statistics_.sub_steps += steps;
    statistics_.rejected += rejected;
    statistics_.evaluations += evaluations;
  }

  SundialsContext context_;
  SundialsVector state_;
  SundialsMemory<ERKStepFree> memory_;
  SundialsMessage message_;
  Rate rate_;
  const MarkerVelocity* velocity_ = nullptr;
  double dt_ = 0.0;
  MarkerStatistics statistics_;
};

}  // namespace

bool have_sundials() {
  return true;
}

std::unique_ptr<MarkerIntegrator> make_arkode_integrator(std::size_t size, const MarkerTolerances& tolerances) {
  if (!(std::isfinite(tolerances.relative) && tolerances.relative >= 0.0 && std::isfinite(tolerances.absolute) &&
        tolerances.absolute > 0.0))
    throw std::invalid_argument("arkode: tolerances " + std::to_string(tolerances.relative) + " (relative) and " +
                                std::to_string(tolerances.absolute) +
                                " (absolute): must be finite, >= 0 and > 0 respectively");
  return std::make_unique<Arkode>(size, tolerances);
}

}  // namespace vesiflow::coupling
