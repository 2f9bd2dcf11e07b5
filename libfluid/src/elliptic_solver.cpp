#include "fluid/elliptic_solver.h"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "fft_solver.h"
#include "message.h"
#include "pcg_solver.h"
#ifdef VESIFLOW_WITH_CHOLMOD
#include "cholmod_solver.h"
#endif

namespace vesiflow::fluid {
namespace {

void check_shape(const char* what, ConstBlocks arrays, const EllipticProblem& problem) {
  if (arrays.count() != problem.blocks()) {
    throw std::invalid_argument(
        message("elliptic solver: ", what, " has ", arrays.count(), " arrays, the problem has ", problem.blocks()));
  }
  for (int block = 0; block < problem.blocks(); ++block) {
    const auto& shape = arrays[block].extent;
    const auto expected = problem.extent(block);
    if (shape == expected) continue;
    throw std::invalid_argument(message("elliptic solver: ", what, " is ", shape[0], " x ", shape[1], " x ", shape[2],
                                        ", the problem has ", expected[0], " x ", expected[1], " x ", expected[2],
                                        " unknowns"));
  }
}

// The inverse of an elliptic operator is full: one number of b that is not finite spoils every number of x.
// So a look at one row of x replaces a pass over b.
bool is_finite(ConstBlocks x) {
  for (const ConstView& block : x) {
    for (int i = 0; i < block.extent[0]; ++i) {
      if (!std::isfinite(block(i, 0, 0))) return false;
    }
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
  const auto start = std::chrono::steady_clock::now();
  viscosity_range_ = problem.mu.checked_range();
  do_update(problem);
  problem_ = problem;
  update_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

SolveReport EllipticSolver::solve(ConstBlocks rhs, Blocks x) {
  const auto start = std::chrono::steady_clock::now();
  check_shape("the right-hand side", rhs, problem_);
  check_shape("the solution", x, problem_);
  SolveReport report = do_solve(rhs, x);
  if (!is_finite(x)) {
    throw std::runtime_error("elliptic solver: the solution is not finite, because the right-hand side is not");
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

SolverChoice choose_solver(const EllipticProblem& problem, const AutoOptions& options) {
  if (problem.form == EllipticForm::laplacian && problem.mu.is_constant()) {
    return {FftOptions{}, "constant coefficients: fast transforms are exact and fastest"};
  }
  PcgOptions pcg;
  pcg.tolerance = options.tolerance;
  return {pcg, "variable or coupled coefficients: iterations do not depend on the grid"};
}

std::unique_ptr<EllipticSolver> make_elliptic_solver(const EllipticProblem& problem, const SolverOptions& options) {
  using Result = std::unique_ptr<EllipticSolver>;
  return std::visit(
      Overloaded{[&](const FftOptions& fft) -> Result { return std::make_unique<FftSolver>(problem, fft); },
                 [&]([[maybe_unused]] const CholmodOptions& cholmod) -> Result {
#ifdef VESIFLOW_WITH_CHOLMOD
                   return std::make_unique<CholmodSolver>(problem, cholmod);
#else
                   refuse_cholmod();
#endif
                 },
                 [&](const PcgOptions& pcg) -> Result { return std::make_unique<PcgSolver>(problem, pcg); },
                 [&](const AutoOptions& automatic) -> Result {
                   return make_elliptic_solver(problem, choose_solver(problem, automatic).options);
                 }},
      options);
}

std::size_t estimate_solver_memory(const EllipticProblem& problem, const SolverOptions& options) {
  return std::visit(
      Overloaded{[&](const FftOptions& fft) { return FftSolver::estimate_memory(problem, fft, omp_get_max_threads()); },
                 [&](const CholmodOptions&) -> std::size_t {
#ifdef VESIFLOW_WITH_CHOLMOD
                   return CholmodSolver::estimate_memory(problem);
#else
                   refuse_cholmod();
#endif
                 },
                 [&](const PcgOptions& pcg) { return PcgSolver::estimate_memory(problem, pcg); },
                 [&](const AutoOptions& automatic) {
                   return estimate_solver_memory(problem, choose_solver(problem, automatic).options);
                 }},
      options);
}

}  // namespace vesiflow::fluid
