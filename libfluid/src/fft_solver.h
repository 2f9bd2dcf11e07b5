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

// The solver of one scalar problem with constant coefficients.
class FftScalarSolver {
 public:
  explicit FftScalarSolver(const EllipticProblem& problem);
  // For another alpha, mu or number of threads.
  void update(const EllipticProblem& problem);
  // Returns the mean that was removed from the right-hand side.
  double solve(ConstView rhs, View x);
  static std::size_t estimate_memory(const EllipticProblem& problem, int threads);

 private:
  // Work space of one thread: that of a plane's transform, and an x-z slab with its elimination factors, rows
  // padded alike.
  struct Scratch {
    Scratch(const std::array<int, 3>& extent, std::ptrdiff_t row_stride);
    AlignedArray transform, slab, factors;
    std::vector<double> column;
  };

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

class FftSolver final : public EllipticSolver {
 public:
  // Throws std::invalid_argument for a variable coefficient or the stress form.
  FftSolver(const EllipticProblem& problem, const FftOptions& options);
  std::string name() const override { return "fft"; }
  static std::size_t estimate_memory(const EllipticProblem& problem, int threads);

 private:
  void do_update(const EllipticProblem& problem) override;
  SolveReport do_solve(ConstBlocks rhs, Blocks x) override;

  FftOptions options_;
  std::vector<std::unique_ptr<FftScalarSolver>> blocks_;
};

}  // namespace vesiflow::fluid
