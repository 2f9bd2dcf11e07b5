// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/fft/fft_solver.h"

#include <stdexcept>

#include "elliptic/fft/plane_solver.h"
#include "elliptic/fft/r2r_solver.h"
#include "message.h"

namespace vesiflow::fluid {
namespace {

std::unique_ptr<FastSolver> make_fast_solver(const EllipticProblem& problem, const FftOptions& options) {
  if (options.transforms == FftOptions::Transforms::fftw_r2r) return std::make_unique<R2rSolver>(problem);
  return std::make_unique<PlaneSolver>(problem);
}

}  // namespace

FftSolver::FftSolver(const EllipticProblem& problem, const FftOptions& options)
    : EllipticSolver(problem), options_(options) {
  update(problem);
}

std::size_t FftSolver::estimate_memory(const EllipticProblem& problem, const FftOptions& options, int threads) {
  std::size_t bytes = 0;
  for (int block = 0; block < problem.blocks(); ++block) {
    const EllipticProblem component = problem.component(block);
    bytes += options.transforms == FftOptions::Transforms::fftw_r2r ? R2rSolver::estimate_memory(component)
                                                                    : PlaneSolver::estimate_memory(component, threads);
  }
  return bytes;
}

void FftSolver::do_update(const EllipticProblem& problem) {
  if (problem.form != EllipticForm::laplacian || !problem.mu.is_constant()) {
    throw std::invalid_argument(message("elliptic solver: 'fft' cannot solve the ", vesiflow::fluid::name(problem.form),
                                        " form with ", problem.mu.is_constant() ? "constant" : "variable",
                                        " viscosity; use 'pcg' (which can take 'fft' as its preconditioner), "
                                        "'cholmod' or 'auto'"));
  }
  const bool planned = may_reuse();
  if (!planned) blocks_.clear();
  for (int block = 0; block < problem.blocks(); ++block) {
    const EllipticProblem component = problem.component(block);
    if (planned) {
      blocks_[block]->update(component);
    } else {
      blocks_.push_back(make_fast_solver(component, options_));
    }
  }
}

SolveReport FftSolver::do_solve(ConstBlocks rhs, Blocks x) {
  SolveReport report;
  for (int block = 0; block < x.count(); ++block) {
    report.removed_mean[block] = blocks_[block]->solve(rhs[block], x[block]);
  }
  return report;
}

}  // namespace vesiflow::fluid
