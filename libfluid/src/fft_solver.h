// The "fft" backend of EllipticSolver (see FftOptions).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "aligned_array.h"
#include "fluid/elliptic_solver.h"
#include "transform_plan.h"

namespace vesiflow::fluid {

class FftSolver final : public EllipticSolver {
 public:
  explicit FftSolver(const EllipticProblem& problem);
  std::string name() const override { return "fft"; }
  static std::size_t estimate_memory(const EllipticProblem& problem, int threads);

 private:
  // Work space of one thread: that of a plane's transform, and an x-z slab with its elimination factors, rows
  // padded alike.
  struct Scratch {
    Scratch(const std::array<int, 3>& extent, std::ptrdiff_t row_stride);
    AlignedArray transform, slab, factors;
    std::vector<double> column;
  };

  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstView rhs, View x) override;
  void solve_slab(View x, int j, Scratch& scratch) const;
  double solve_singular_column(ConstView x, Scratch& scratch) const;

  std::array<int, 3> extent_{};
  std::ptrdiff_t row_stride_ = 0;
  double alpha_ = 0.0;
  double mu_ = 0.0;
  std::array<std::vector<double>, 2> eigenvalues_;  // of the one-dimensional -Laplacian along x and y
  double z_coupling_ = 0.0;                         // 1 / h_z^2
  double z_end_diagonal_ = 2.0;                     // times z_coupling_
  double normalisation_ = 1.0;                      // of a transform pair
  bool nullspace_ = false;
  std::unique_ptr<TransformPlan> forward_, backward_;
  std::vector<Scratch> scratch_;
};

}  // namespace vesiflow::fluid
