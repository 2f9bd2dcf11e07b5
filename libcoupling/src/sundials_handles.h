#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

namespace vesiflow::coupling {

/// Owners of what SUNDIALS hands out, declared in the order in which they must be made.
struct FreeSundials {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
using SundialsContext = std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeSundials>;
using SundialsVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeSundials>;

inline SundialsContext make_sundials_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return SundialsContext(context);
}

inline SundialsVector make_sundials_vector(std::size_t size, SUNContext context) {
  SundialsVector vector(N_VNew_Serial(static_cast<sunindextype>(size), context));
  if (!vector) throw std::bad_alloc();
  return vector;
}

inline std::span<double> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

/// SUNDIALS' own messages are kept for ours and not printed.
inline void keep_message(int /*code*/, const char* /*module*/, const char* /*function*/, char* text, void* user) {
  *static_cast<std::string*>(user) = text;
}

/// The name of a return flag, which SUNDIALS allocates.
inline std::string take_name(char* allocated) {
  const std::unique_ptr<char, void (*)(void*)> owner(allocated, std::free);
  return owner.get();
}

}  // namespace vesiflow::coupling
