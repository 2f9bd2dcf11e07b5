// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/gmres.h"

#include <cmath>

namespace vesiflow::coupling {

Gmres::Gmres(int max_iterations)
    : max_iterations_(max_iterations),
      hessenberg_(max_iterations + 1, max_iterations),
      cosines_(max_iterations),
      sines_(max_iterations),
      right_side_(max_iterations + 1) {}

// Applies the rotations so far to a new column of the Hessenberg matrix, and makes and applies the one that clears
// its last row.
void Gmres::rotate(int k) {
  for (int i = 0; i < k; ++i) {
    const double upper = hessenberg_(i, k), lower = hessenberg_(i + 1, k);
    hessenberg_(i, k) = cosines_(i) * upper + sines_(i) * lower;
    hessenberg_(i + 1, k) = cosines_(i) * lower - sines_(i) * upper;
  }
  const double diagonal = std::hypot(hessenberg_(k, k), hessenberg_(k + 1, k));
  cosines_(k) = hessenberg_(k, k) / diagonal;
  sines_(k) = hessenberg_(k + 1, k) / diagonal;
  hessenberg_(k, k) = diagonal;
  right_side_(k + 1) = -sines_(k) * right_side_(k);
  right_side_(k) *= cosines_(k);
}

Gmres::Report Gmres::solve(const Operator& apply, const Vector& b, double tolerance, Vector& x) {
  x.setZero(b.size());
  const double size = b.norm();
  if (size == 0.0) return {};
  basis_.resize(b.size(), max_iterations_ + 1);
  basis_.col(0) = b / size;
  right_side_.setZero();
  right_side_(0) = size;
  int k = 0;
  double residual = 1.0;
  while (k < max_iterations_ && residual > tolerance) {
    direction_ = basis_.col(k);
    apply(direction_, product_);
    for (int i = 0; i <= k; ++i) {
      hessenberg_(i, k) = basis_.col(i).dot(product_);
      product_ -= hessenberg_(i, k) * basis_.col(i);
    }
    const double length = product_.norm();
    hessenberg_(k + 1, k) = length;
    if (length > 0.0) basis_.col(k + 1) = product_ / length;
    rotate(k);
    ++k;
    residual = std::abs(right_side_(k)) / size;
  }
  // Back substitution; the coefficients of the basis take the place of the right-hand side.
  for (int i = k - 1; i >= 0; --i) {
    for (int j = i + 1; j < k; ++j) right_side_(i) -= hessenberg_(i, j) * right_side_(j);
    right_side_(i) /= hessenberg_(i, i);
    x += right_side_(i) * basis_.col(i);
  }
  return {k, residual};
}

}  // namespace vesiflow::coupling
