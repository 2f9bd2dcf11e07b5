// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "elliptic/fft/fft_solver.h"

#include <algorithm>
#include <stdexcept>

#include "elliptic/fft/plane_solver.h"
#include "elliptic/fft/r2r_solver.h"
#include "message.h"

namespace vesiflow::fluid {
namespace {

const FftOptions& checked(const FftOptions& options) {
  if (options.arithmetic == FftOptions::Arithmetic::double_) return options;
  if (options.transforms == FftOptions::Transforms::fftw_r2r) {
    throw std::invalid_argument(
        "elliptic solver: the arithmetic of 'fft' is single with the transforms 'fftw_r2r', which are a reference in "
        "double precision; take 'pairs_of_lines' or double");
  }
  return options;
}

// Of the array that the solvers of the blocks share.
std::size_t single_work_size(const EllipticProblem& problem) {
  std::size_t size = 0;
  for (int block = 0; block < problem.blocks(); ++block)
    size = std::max(size, PlaneSolver<float>::work_size(problem.component(block)));
  return size;
}

}  // namespace

FftSolver::FftSolver(const EllipticProblem& problem, const FftOptions& options)
    : EllipticSolver(problem), options_(checked(options)) {
  update(problem);
}

std::size_t FftSolver::estimate_memory(const EllipticProblem& problem, const FftOptions& options, int threads) {
  std::size_t bytes = 0;
  for (int block = 0; block < problem.blocks(); ++block) {
    const EllipticProblem component = problem.component(block);
    if (options.transforms == FftOptions::Transforms::fftw_r2r) {
      bytes += R2rSolver::estimate_memory(component);
    } else if (checked(options).arithmetic == FftOptions::Arithmetic::double_) {
      bytes += PlaneSolver<double>::estimate_memory(component, threads);
    } else {
      bytes += PlaneSolver<float>::estimate_memory(component, threads);
    }
  }
  if (options.arithmetic == FftOptions::Arithmetic::single) bytes += sizeof(float) * single_work_size(problem);
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
  const auto make = [&](const EllipticProblem& component) -> std::unique_ptr<FastSolver> {
    if (options_.transforms == FftOptions::Transforms::fftw_r2r) return std::make_unique<R2rSolver>(component);
    if (options_.arithmetic == FftOptions::Arithmetic::single)
      return std::make_unique<PlaneSolver<float>>(component, single_work_);
    return std::make_unique<PlaneSolver<double>>(component, nullptr);
  };
  if (!planned && options_.arithmetic == FftOptions::Arithmetic::single)
    single_work_ = allocate_aligned<float>(single_work_size(problem));
  for (int block = 0; block < problem.blocks(); ++block) {
    const EllipticProblem component = problem.component(block);
    if (planned) {
      blocks_[block]->update(component);
    } else {
      blocks_.push_back(make(component));
    }
  }
}

SolveReport FftSolver::do_solve(ConstBlocks rhs, Blocks x) {
  SolveReport report;
  for (int block = 0; block < x.count(); ++block) {
    report.removed_mean[block] = blocks_[block]->solve(rhs[block], x[block], nullptr);
  }
  return report;
}

SolveReport FftSolver::do_add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x) {
  SolveReport report;
  for (int block = 0; block < x.count(); ++block) {
    report.removed_mean[block] = blocks_[block]->solve(rhs[block], x[block], &base[block]);
  }
  return report;
}

}  // namespace vesiflow::fluid
