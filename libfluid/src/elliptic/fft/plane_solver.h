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

// In double precision a solve works in the array of the solution. In single precision it works in an array between the
// two, which the solvers of the components share.
template <class Scalar>
class PlaneSolver final : public FastSolver {
 public:
  // work: work_size() numbers from allocate_aligned, which others may use between solves; not read for double.
  PlaneSolver(const EllipticProblem& problem, std::shared_ptr<Scalar[]> work);
  void update(const EllipticProblem& problem) override;
  double solve(ConstView rhs, View x, const ConstView* base) override;
  static std::size_t work_size(const EllipticProblem& problem);
  // Without work.
  static std::size_t estimate_memory(const EllipticProblem& problem, int threads);

 private:
  using Plan = TransformPlan<Scalar>;

  // Work space of one thread.
  struct Scratch {
    explicit Scratch(const PlaneSolver& solver);
    AlignedArrayOf<Scalar> transform;
    typename ColumnSolver<Scalar>::Scratch columns;
    std::vector<double> shift;
  };
  // Where the modes stand.
  struct Modes {
    Scalar* data;
    std::ptrdiff_t row_stride, plane_stride;
    Scalar* row(int j, int k) const { return data + j * row_stride + k * plane_stride; }
  };

  Modes modes_in(View x) const;
  double solve_slab(const Modes& modes, int j, Scratch& scratch) const;

  std::array<int, 3> extent_;
  std::array<Basis, 2> basis_;  // along x and y
  Plan forward_, backward_;
  int width_;  // columns solved at a time
  ColumnSolver<Scalar> columns_;
  std::array<std::vector<double>, 2> eigenvalues_;  // of the one-dimensional -Laplacian along x and y
  double z_coupling_;                               // 1 / h_z^2
  double normalisation_;                            // of a transform pair
  double alpha_ = 0.0;
  double mu_ = 0.0;
  std::shared_ptr<Scalar[]> work_;
  std::vector<Scratch> scratch_;
};

}  // namespace vesiflow::fluid
