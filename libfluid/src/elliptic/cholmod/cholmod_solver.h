// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The "cholmod" backend of EllipticSolver (see CholmodOptions).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid {

// Solves with the factor it has, which is that of its problem only if the policy lets no factor lag: otherwise this is a
// preconditioner.
class CholmodSolver final : public EllipticSolver {
 public:
  // Throws std::invalid_argument for options out of range, and if the factor is estimated to exceed a limit.
  CholmodSolver(const EllipticProblem& problem, const CholmodOptions& options);
  ~CholmodSolver() override;
  std::string name() const override { return fluid::name(SolverKind::cholmod); }
  int factorisations() const override { return factorisations_; }

 private:
  struct Workspace;

  // The coefficients that a factor was computed for.
  class Coefficients {
   public:
    Coefficients() = default;
    explicit Coefficients(const EllipticProblem& problem);
    // Whether alpha or mu somewhere differs from this by more than a fraction of it, or a nullspace came or went.
    bool moved(const EllipticProblem& problem, double fraction) const;

   private:
    double alpha_ = 0.0;
    bool has_nullspace_ = false;
    std::vector<double> mu_;  // a constant, or the storage of the field
  };

  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstBlocks rhs, Blocks x) override;
  bool needs_factorisation(const EllipticProblem& problem) const;

  CholmodOptions options_;
  std::unique_ptr<Workspace> workspace_;
  Coefficients factored_;
  std::int64_t updates_since_ = 0;  // the last factorisation
  int factorisations_ = 0;
};

}  // namespace vesiflow::fluid
