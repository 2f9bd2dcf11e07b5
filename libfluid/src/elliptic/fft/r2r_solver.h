// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The reference of the "fft" backend: FFTW's three-dimensional real-to-real transform and a division by the sum of
// three eigenvalues.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "elliptic/fft/fast_solver.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {

// Serial.
class R2rSolver final : public FastSolver {
 public:
  explicit R2rSolver(const EllipticProblem& problem);
  ~R2rSolver() override;
  void update(const EllipticProblem& problem) override;
  double solve(ConstView rhs, View x, const ConstView* base) override;
  static std::size_t estimate_memory(const EllipticProblem& problem);

 private:
  void divide();

  struct Plans;
  std::array<int, 3> extent_;
  std::array<std::vector<double>, 3> eigenvalues_;  // of the one-dimensional -Laplacians
  double normalisation_ = 1.0;
  double alpha_ = 0.0;
  double mu_ = 0.0;
  bool nullspace_ = false;
  AlignedArray work_;
  std::unique_ptr<Plans> plans_;
};

}  // namespace vesiflow::fluid
