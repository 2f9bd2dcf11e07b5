// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/fixed_point.h"

#include <fmt/format.h>
#include <kinsol/kinsol.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

#include "motion/constants.h"
#include "sundials_handles.h"

namespace vesiflow::coupling {
namespace {

class Kinsol final : public FixedPoint {
 public:
  Kinsol(std::size_t size, const Limits& limits)
      : limits_(limits),
        context_(make_sundials_context()),
        x_(make_sundials_vector(size, context_)),
        ones_(make_sundials_vector(size, context_)),
        memory_(KINCreate(context_)),
        function_([this](std::span<const double> x, std::span<double> result) { (*map_)(x, result); }) {
    if (!memory_) throw std::bad_alloc();
    N_VConst(1.0, ones_);
    check(KINSetErrHandlerFn(memory_.get(), SundialsMessage::keep, &message_));
    check(KINSetUserData(memory_.get(), &function_));
    check(KINSetNumMaxIters(memory_.get(), limits.evaluations));
    check(KINSetMAA(memory_.get(),
                    std::min({constants::remembered_iterates, limits.evaluations - 1, static_cast<int>(size)})));
    check(KINInit(memory_.get(), SundialsFunction<>::call, x_));
    check(KINSetFuncNormTol(memory_.get(), limits.tolerance));
    check(KINSetReturnNewest(memory_.get(), SUNTRUE));
  }

  void solve(const Map& map, std::span<double> x) override {
    map_ = &map;
    message_ = {};
    std::ranges::copy(x, values(x_).begin());
    const int flag = KINSol(memory_.get(), x_, KIN_FP, ones_, ones_);
    function_.rethrow();
    if (flag == KIN_MAXITER_REACHED) {
      double change = 0.0;
      KINGetFuncNorm(memory_.get(), &change);
      throw NoFixedPoint(fmt::format("after {} evaluations the last change is {:.3g}, the tolerance {:g}",
                                     limits_.evaluations, change, limits_.tolerance));
    }
    check(flag);
    std::ranges::copy(values(x_), x.begin());
    // KINSOL's norm of what is not finite may be zero.
    if (!std::ranges::all_of(x, [](double value) { return std::isfinite(value); }))
      throw NoFixedPoint("the iterates are not finite");
  }

 private:
  void check(int flag) const {
    if (flag >= 0) return;
    throw std::domain_error("kinsol: " + take_name(KINGetReturnFlagName(flag)) +
                            (message_.text.empty() ? "" : ": " + message_.text));
  }

  Limits limits_;
  SundialsContext context_;
  SundialsVector x_, ones_;
  SundialsMemory<KINFree> memory_;
  SundialsMessage message_;
  const Map* map_ = nullptr;
  SundialsFunction<> function_;
};

}  // namespace

std::unique_ptr<FixedPoint> make_fixed_point(std::size_t size, const FixedPoint::Limits& limits) {
  return std::make_unique<Kinsol>(size, limits);
}

}  // namespace vesiflow::coupling
