// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/elliptic_solver.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "operators/block_algebra.h"
#include "operators/check_blocks.h"

namespace vesiflow::fluid {
namespace {

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

}  // namespace

void EllipticSolver::update(const EllipticProblem& problem) {
  const auto start = std::chrono::steady_clock::now();
  viscosity_range_ = problem.mu.checked_range();
  may_reuse_ = std::exchange(ready_, false) && problem.same_structure(problem_);
  do_update(problem);
  problem_ = problem;
  ready_ = true;
  update_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

namespace {

// The report of solve(), which has found x.
template <class Do>
SolveReport finite_and_timed(Blocks x, const Do& solve) {
  const auto start = std::chrono::steady_clock::now();
  SolveReport report = solve();
  if (!is_finite(x)) {
    throw std::runtime_error("elliptic solver: the solution is not finite, because the right-hand side is not");
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace

void EllipticSolver::check_ready(ConstBlocks rhs, ConstBlocks x) const {
  if (!ready_) throw std::runtime_error("elliptic solver: the last update failed; update it again");
  check_blocks("elliptic solver", "the right-hand side", rhs, problem_);
  check_blocks("elliptic solver", "the solution", x, problem_);
}

SolveReport EllipticSolver::solve(ConstBlocks rhs, Blocks x) {
  check_ready(rhs, x);
  return finite_and_timed(x, [&] { return do_solve(rhs, x); });
}

SolveReport EllipticSolver::add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x) {
  check_ready(rhs, x);
  check_blocks("elliptic solver", "what the solution is added to", base, problem_);
  return finite_and_timed(x, [&] { return do_add_solution(rhs, base, x); });
}

SolveReport EllipticSolver::do_add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x) {
  if (rhs[0].data != x[0].data) set_zero(x);
  const SolveReport report = do_solve(rhs, x);
  add(1.0, base, x);
  return report;
}

}  // namespace vesiflow::fluid
