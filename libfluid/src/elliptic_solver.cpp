#include "fluid/elliptic_solver.h"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "fft_solver.h"
#include "message.h"
#ifdef VESIFLOW_WITH_CHOLMOD
#include "cholmod_solver.h"
#endif

namespace vesiflow::fluid {
namespace {

void check_shape(const char* what, const std::array<int, 3>& shape, const std::array<int, 3>& expected) {
  if (shape == expected) return;
  throw std::invalid_argument(message("elliptic solver: ", what, " is ", shape[0], " x ", shape[1], " x ", shape[2],
                                      ", the problem has ", expected[0], " x ", expected[1], " x ", expected[2],
                                      " unknowns"));
}

// The inverse of an elliptic operator is full: one number of b that is not finite spoils every number of x.
// So a look at one row of x replaces a pass over b.
bool is_finite(ConstView x) {
  for (int i = 0; i < x.extent[0]; ++i) {
    if (!std::isfinite(x(i, 0, 0))) return false;
  }
  return true;
}

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

#ifndef VESIFLOW_WITH_CHOLMOD
[[noreturn]] void refuse_cholmod() {
  throw std::invalid_argument(
      "elliptic solver: 'cholmod' is not in this build; configure with VESIFLOW_WITH_CHOLMOD=ON, or use "
      "'fft'");
}
#endif

}  // namespace

void EllipticSolver::update(const EllipticProblem& problem) {
  do_update(problem);
  problem_ = problem;
}

SolveReport EllipticSolver::solve(ConstView rhs, View x) {
  const auto start = std::chrono::steady_clock::now();
  check_shape("the right-hand side", rhs.extent, problem_.extent());
  check_shape("the solution", x.extent, problem_.extent());
  SolveReport report = do_solve(rhs, x);
  if (!is_finite(x)) {
    throw std::runtime_error("elliptic solver: the solution is not finite, because the right-hand side is not");
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::unique_ptr<EllipticSolver> make_elliptic_solver(const EllipticProblem& problem, const SolverOptions& options) {
  using Result = std::unique_ptr<EllipticSolver>;
  return std::visit(Overloaded{[&](const FftOptions&) -> Result { return std::make_unique<FftSolver>(problem); },
                               [&]([[maybe_unused]] const CholmodOptions& cholmod) -> Result {
#ifdef VESIFLOW_WITH_CHOLMOD
                                 return std::make_unique<CholmodSolver>(problem, cholmod);
#else
                                 refuse_cholmod();
#endif
                               }},
                    options);
}

std::size_t estimate_solver_memory(const EllipticProblem& problem, const SolverOptions& options) {
  return std::visit(
      Overloaded{[&](const FftOptions&) { return FftSolver::estimate_memory(problem, omp_get_max_threads()); },
                 [&](const CholmodOptions&) -> std::size_t {
#ifdef VESIFLOW_WITH_CHOLMOD
                   return CholmodSolver::estimate_memory(problem);
#else
                   refuse_cholmod();
#endif
                 }},
      options);
}

}  // namespace vesiflow::fluid
