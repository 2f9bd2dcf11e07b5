// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What SUNDIALS hands out, what it calls and what it says, for whoever is compiled with it.
#pragma once

#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.hpp>

namespace vesiflow {

using SundialsContext = sundials::Context;
using SundialsVector = sundials::experimental::NVectorView;

inline SundialsContext make_sundials_context() {
  SundialsContext context;
  if (static_cast<SUNContext>(context) == nullptr) throw std::bad_alloc();
  return context;
}

/// The context must outlive the vector.
inline SundialsVector make_sundials_vector(std::size_t size, SUNContext context) {
  SundialsVector vector(N_VNew_Serial(static_cast<sunindextype>(size), context));
  if (static_cast<N_Vector>(vector) == nullptr) throw std::bad_alloc();
  return vector;
}

inline std::span<double> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

/// Owner of the memory of a solver, which `release` frees: KINFree, CVodeFree, ERKStepFree. SUNDIALS 6 has no C++ for
/// it.
template <void (*release)(void**)>
struct FreeSundialsMemory {
  void operator()(void* memory) const { release(&memory); }
};
template <void (*release)(void**)>
using SundialsMemory = std::unique_ptr<void, FreeSundialsMemory<release>>;

/// The last message of SUNDIALS, which is kept for ours and not printed: keep() is an error handler whose data is
/// such a message.
struct SundialsMessage {
  std::string function, text;

  static void keep(int /*code*/, const char* /*module*/, const char* function, char* text, void* message) {
    *static_cast<SundialsMessage*>(message) = {function, text};
  }
};

/// The name of a return flag, which SUNDIALS allocates.
inline std::string take_name(char* allocated) {
  const std::unique_ptr<char, void (*)(void*)> owner(allocated, std::free);
  return owner.get();
}

/// A function of C++ that SUNDIALS calls, by call() with this object as its data: result = f(x), or f(t, x) for
/// Parameters = double. What it throws must not pass through C, so it is kept, SUNDIALS is told to stop, and
/// rethrow() throws it. std::domain_error may stand for an x where there is no result: SUNDIALS then tries one that
/// is nearer.
template <typename... Parameters>
class SundialsFunction {
 public:
  using Function = std::function<void(Parameters..., std::span<const double> x, std::span<double> result)>;
  enum class DomainErrors { stop, try_nearer };

  explicit SundialsFunction(Function function, DomainErrors domain_errors = DomainErrors::stop)
      : function_(std::move(function)), domain_errors_(domain_errors) {}

  static int call(Parameters... parameters, N_Vector x, N_Vector result, void* self) {
    return static_cast<SundialsFunction*>(self)->evaluate(parameters..., values(x), values(result));
  }

  /// Throws what the function has thrown since the last time.
  void rethrow() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  int evaluate(Parameters... parameters, std::span<const double> x, std::span<double> result) noexcept {
    constexpr int done = 0, recoverable = 1, failed = -1;
    try {
      function_(parameters..., x, result);
      return done;
    } catch (const std::domain_error&) {
      if (domain_errors_ == DomainErrors::try_nearer) return recoverable;
      error_ = std::current_exception();
    } catch (...) {
      error_ = std::current_exception();
    }
    return failed;
  }

  Function function_;
  DomainErrors domain_errors_;
  std::exception_ptr error_;
};

}  // namespace vesiflow
