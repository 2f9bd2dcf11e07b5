#include "arkode_integrator.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "sundials_handles.h"

namespace vesiflow::coupling {
namespace {

struct FreeErkStep {
  void operator()(void* memory) const { ERKStepFree(&memory); }
};

// Every step is a problem of its own, from time 0 to dt: nothing is remembered from one to the next, so that a continued run
// repeats the uninterrupted one bit for bit.
class Arkode final : public MarkerIntegrator {
 public:
  Arkode(std::size_t size, const MarkerTolerances& tolerances)
      : context_(make_sundials_context()), state_(make_sundials_vector(size, context_.get())) {
    N_VConst(0.0, state_.get());
    memory_.reset(ERKStepCreate(evaluate, 0.0, state_.get(), context_.get()));
    if (!memory_) throw std::bad_alloc();
    check(ERKStepSetErrHandlerFn(memory_.get(), keep_message, &message_));
    check(ERKStepSetUserData(memory_.get(), this));
    check(ERKStepSetOrder(memory_.get(), 3));
    check(ERKStepSStolerances(memory_.get(), tolerances.relative, tolerances.absolute));
  }

  void advance(double dt, const MarkerVelocity& velocity, std::span<double> state) override {
    velocity_ = &velocity;
    dt_ = dt;
    error_ = nullptr;
    message_.clear();
    std::ranges::copy(state, values(state_.get()).begin());
    check(ERKStepReInit(memory_.get(), evaluate, 0.0, state_.get()));
    // The whole step, if the tolerance allows it; and no evaluation beyond its end, where no fluid velocity is known.
    check(ERKStepSetInitStep(memory_.get(), dt));
    check(ERKStepSetStopTime(memory_.get(), dt));
    double reached = 0.0;
    const int flag = ERKStepEvolve(memory_.get(), dt, state_.get(), &reached, ARK_NORMAL);
    count();
    if (error_) std::rethrow_exception(error_);
    check(flag);
    std::ranges::copy(values(state_.get()), state.begin());
  }

  MarkerStatistics statistics() const override { return statistics_; }

 private:
  static int evaluate(double time, N_Vector state, N_Vector velocity, void* user) {
    auto& self = *static_cast<Arkode*>(user);
    try {
      (*self.velocity_)(std::min(1.0, time / self.dt_), values(state), values(velocity));
      return 0;
    } catch (...) {  // must not pass through C
      self.error_ = std::current_exception();
      return -1;
    }
  }

  void check(int flag) const {
    if (flag >= 0) return;
    throw std::domain_error("arkode: " + take_name(ERKStepGetReturnFlagName(flag)) +
                            (message_.empty() ? "" : ": " + message_));
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
  std::unique_ptr<void, FreeErkStep> memory_;
  std::string message_;
  const MarkerVelocity* velocity_ = nullptr;
  double dt_ = 0.0;
  std::exception_ptr error_;
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
