// The "cholmod" backend of EllipticSolver (see CholmodOptions).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid {

class CholmodSolver final : public EllipticSolver {
 public:
  // Throws std::invalid_argument if the factor is estimated larger than options.memory_limit.
  CholmodSolver(const EllipticProblem& problem, const CholmodOptions& options);
  ~CholmodSolver() override;
  std::string name() const override { return "cholmod"; }
  static std::size_t estimate_memory(const EllipticProblem& problem);

 private:
  struct Workspace;

  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstBlocks rhs, Blocks x) override;

  CholmodOptions options_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace vesiflow::fluid
