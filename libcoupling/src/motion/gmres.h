// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

namespace vesiflow::coupling {

/// Solves A x = b by GMRES without restarts (Saad & Schultz 1986, doi:10.1137/0907058), started at zero. Allocates in
/// the first solve only.
class Gmres {
 public:
  using Vector = Eigen::VectorXd;
  using Operator = std::function<void(const Vector& x, Vector& result)>;

  explicit Gmres(int max_iterations);

  struct Report {
    int iterations = 0;
    double residual = 0.0;  ///< |b - A x| / |b|
  };
  /// Stops when the residual is below `tolerance`, or after the greatest number of iterations.
  Report solve(const Operator& apply, const Vector& b, double tolerance, Vector& x);

 private:
  void rotate(int column);

  int max_iterations_;
  Eigen::MatrixXd basis_, hessenberg_;  // Krylov vectors in columns; triangular after the rotations
  Vector direction_, product_, cosines_, sines_, right_side_;
};

}  // namespace vesiflow::coupling
