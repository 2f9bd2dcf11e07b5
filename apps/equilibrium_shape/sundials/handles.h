#pragma once

#include <memory>
#include <string>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <Eigen/Core>

namespace equilibrium {

/// Owners of what SUNDIALS hands out, declared in the order in which they must be made.
struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeLinearSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
using ContextHandle = std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext>;
using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, FreeVector>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, FreeMatrix>;
using LinearSolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, FreeLinearSolver>;

inline ContextHandle make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return ContextHandle(context);
}

inline Eigen::Map<Eigen::VectorXd> values(N_Vector vector) {
  return {N_VGetArrayPointer(vector), N_VGetLength(vector)};
}

/// SUNDIALS' own error messages are kept for the report and not printed.
inline void keep_message(int /*code*/, const char* /*module*/, const char* function, char* text, void* user) {
  *static_cast<std::string*>(user) = std::string(function) + ": " + text;
}

}  // namespace equilibrium
