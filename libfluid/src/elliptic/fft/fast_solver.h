// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Solvers of one scalar problem with constant coefficients by fast transforms, of which FftSolver is made.
#pragma once

#include "fluid/elliptic_problem.h"

namespace vesiflow::fluid {

class FastSolver {
 public:
  virtual ~FastSolver() = default;
  FastSolver(const FastSolver&) = delete;
  FastSolver& operator=(const FastSolver&) = delete;

  // For another alpha, mu or number of threads.
  virtual void update(const EllipticProblem& problem) = 0;
  // x becomes the solution, or the sum of *base and the solution. Returns the mean that was removed from the right-hand
  // side. rhs and x may be the same.
  virtual double solve(ConstView rhs, View x, const ConstView* base) = 0;

 protected:
  FastSolver() = default;
};

}  // namespace vesiflow::fluid
