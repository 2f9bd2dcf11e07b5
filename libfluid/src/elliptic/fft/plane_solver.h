// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Solves one scalar problem by fast transforms of planes in cache (FftOptions::Transforms::pairs_of_lines).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "elliptic/fft/column_solver.h"
#include "elliptic/fft/fast_solver.h"
#include "elliptic/fft/transform_plan.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {

class PlaneSolver final : public FastSolver {
 public:
  explicit PlaneSolver(const EllipticProblem& problem);
  void update(const EllipticProblem& problem) override;
  double solve(ConstView rhs, View x) override;
  static std::size_t estimate_memory(const EllipticProblem& problem, int threads);

 private:
  // Work space of one thread.
  struct Scratch {
    explicit Scratch(const PlaneSolver& solver);
    AlignedArray transform;
    ColumnSolver::Scratch columns;
    std::vector<double> shift;
  };

  double solve_slab(View x, int j, Scratch& scratch) const;

  std::array<int, 3> extent_;
  std::array<Basis, 2> basis_;  // along x and y
  TransformPlan forward_, backward_;
  int width_;  // columns solved at a time
  ColumnSolver columns_;
  std::array<std::vector<double>, 2> eigenvalues_;  // of the one-dimensional -Laplacian along x and y
  double z_coupling_;                               // 1 / h_z^2
  double normalisation_;                            // of a transform pair
  double alpha_ = 0.0;
  double mu_ = 0.0;
  std::vector<Scratch> scratch_;
};

}  // namespace vesiflow::fluid
