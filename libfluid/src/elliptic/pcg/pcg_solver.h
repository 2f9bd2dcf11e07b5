// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "pcg" backend of EllipticSolver (see PcgOptions).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "fluid/elliptic_solver.h"
#include "operators/block_algebra.h"
#include "operators/stencil.h"

namespace vesiflow::fluid {

class PcgSolver final : public EllipticSolver {
 public:
  // Throws std::invalid_argument for options out of range, and what the preconditioner throws.
  PcgSolver(const EllipticProblem& problem, const PcgOptions& options);
  std::string name() const override;
  int factorisations() const override { return preconditioner_->factorisations(); }
  static std::size_t estimate_memory(const EllipticProblem& problem, const PcgOptions& options);

 private:
  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstBlocks rhs, Blocks x) override;
  EllipticProblem preconditioning_problem(const EllipticProblem& problem) const;
  void set_scale(const EllipticProblem& problem, double reference);
  void precondition(ConstBlocks r, Blocks z);

  PcgOptions options_;
  bool single_ = false;  // whether the preconditioner computes in single precision
  std::unique_ptr<EllipticSolver> preconditioner_;
  std::unique_ptr<Stencil> stencil_;
  std::unique_ptr<GhostedBlocks> scale_;      // of r before and z after "fft", if mu is a field; else null
  std::unique_ptr<GhostedBlocks> direction_;  // p
  std::unique_ptr<GhostedBlocks> product_, residual_, preconditioned_;  // A p, r, M^-1 r
  PlaneSums plane_sums_;
};

}  // namespace vesiflow::fluid
