// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The operator of EllipticProblem as a sparse matrix, for factorisation.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid/elliptic_problem.h"

namespace vesiflow::fluid {

// The lower triangle, by compressed columns. The unknowns are numbered block after block, x fastest.
//
// It is assembled from the energy <x, A x> = alpha |x|^2 + sum over strains e of w_e mu_e (b_e . x)^2, where b_e . x is a
// difference quotient or, at an edge in the stress form, the sum of two (A = alpha I + sum of w_e mu_e b_e b_e^T); so it
// shares nothing with the stencils of stencil.h, and is symmetric and positive by construction.
//
// With a nullspace one unknown of each block, its last, is held at zero ("grounded"): its row and column are zero but for
// the diagonal. What is left is positive definite; solutions of compatible systems then differ from those of zero mean
// by a constant per block. The pattern depends on the structure of the problem alone.
class SparseOperator {
 public:
  explicit SparseOperator(const EllipticProblem& problem);
  // Values for another alpha and mu.
  void update(const EllipticProblem& problem);

  std::int64_t size() const { return static_cast<std::int64_t>(column_starts_.size()) - 1; }
  std::size_t entries() const { return values_.size(); }
  // First entry of each column, and one past the last of all; rows ascend in each column.
  std::vector<std::int64_t>& column_starts() { return column_starts_; }
  std::vector<std::int64_t>& rows() { return rows_; }
  std::vector<double>& values() { return values_; }

  // First unknown of each block, and one past the last of all.
  const std::array<std::int64_t, 4>& block_starts() const { return block_starts_; }

 private:
  void add(std::int64_t row, std::int64_t column, double value);

  std::array<std::int64_t, 4> block_starts_{};
  std::vector<std::int64_t> column_starts_, rows_;
  std::vector<double> values_;
};

}  // namespace vesiflow::fluid
