#include "fixed_point.h"

#include <fmt/format.h>
#include <kinsol/kinsol.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "sundials_handles.h"

namespace vesiflow::coupling {
namespace {

constexpr int remembered_iterates = 20;

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

class Kinsol final : public FixedPoint {
 public:
  Kinsol(std::size_t size, const Limits& limits)
      : limits_(limits),
        context_(make_sundials_context()),
        x_(make_sundials_vector(size, context_.get())),
        ones_(make_sundials_vector(size, context_.get())),
        memory_(KINCreate(context_.get())) {
    if (!memory_) throw std::bad_alloc();
    N_VConst(1.0, ones_.get());
    check(KINSetErrHandlerFn(memory_.get(), keep_message, &message_));
    check(KINSetUserData(memory_.get(), this));
    check(KINSetNumMaxIters(memory_.get(), limits.evaluations));
    check(KINSetMAA(memory_.get(), std::min({remembered_iterates, limits.evaluations - 1, static_cast<int>(size)})));
    check(KINInit(memory_.get(), evaluate, x_.get()));
    check(KINSetFuncNormTol(memory_.get(), limits.tolerance));
    check(KINSetReturnNewest(memory_.get(), SUNTRUE));
  }

  void solve(const Map& map, std::span<double> x) override {
    map_ = &map;
    error_ = nullptr;
    message_.clear();
    std::ranges::copy(x, values(x_.get()).begin());
    const int flag = KINSol(memory_.get(), x_.get(), KIN_FP, ones_.get(), ones_.get());
    if (error_) std::rethrow_exception(error_);
    if (flag == KIN_MAXITER_REACHED) {
      double change = 0.0;
      KINGetFuncNorm(memory_.get(), &change);
      throw NoFixedPoint(fmt::format("after {} evaluations the last change is {:.3g}, the tolerance {:g}",
                                     limits_.evaluations, change, limits_.tolerance));
    }
    check(flag);
    std::ranges::copy(values(x_.get()), x.begin());
    // KINSOL's norm of what is not finite may be zero.
    if (!std::ranges::all_of(x, [](double value) { return std::isfinite(value); }))
      throw NoFixedPoint("the iterates are not finite");
  }

 private:
  static int evaluate(N_Vector x, N_Vector result, void* user) {
    auto& self = *static_cast<Kinsol*>(user);
    try {
      (*self.map_)(values(x), values(result));
      return 0;
    } catch (...) {  // must not pass through C
      self.error_ = std::current_exception();
      return -1;
    }
  }

  void check(int flag) const {
    if (flag >= 0) return;
    throw std::domain_error("kinsol: " + take_name(KINGetReturnFlagName(flag)) +
                            (message_.empty() ? "" : ": " + message_));
  }

  Limits limits_;
  SundialsContext context_;
  SundialsVector x_, ones_;
  std::unique_ptr<void, FreeKinsol> memory_;
  std::string message_;
  const Map* map_ = nullptr;
  std::exception_ptr error_;
};

}  // namespace

std::unique_ptr<FixedPoint> make_fixed_point(std::size_t size, const FixedPoint::Limits& limits) {
  return std::make_unique<Kinsol>(size, limits);
}

}  // namespace vesiflow::coupling
