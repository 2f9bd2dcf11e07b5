// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "fft" backend of EllipticSolver (see FftOptions).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "elliptic/fft/fast_solver.h"
#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid {

class FftSolver final : public EllipticSolver {
 public:
  // Throws std::invalid_argument for a variable coefficient or the stress form, and for an arithmetic that the build or
  // the transforms do not have.
  FftSolver(const EllipticProblem& problem, const FftOptions& options);
  std::string name() const override { return fluid::name(SolverKind::fft); }
  static std::size_t estimate_memory(const EllipticProblem& problem, const FftOptions& options, int threads);

 private:
  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstBlocks rhs, Blocks x) override;
  SolveReport do_add_solution(ConstBlocks rhs, ConstBlocks base, Blocks x) override;

  FftOptions options_;
  std::shared_ptr<float[]> single_work_;  // of all blocks, in single precision
  std::vector<std::unique_ptr<FastSolver>> blocks_;
};

}  // namespace vesiflow::fluid
