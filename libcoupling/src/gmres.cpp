#include "gmres.h"

#include <cmath>

namespace vesiflow::coupling {

Gmres::Gmres(int iterations)
    : max_iterations_(iterations),
      hessenberg_(iterations + 1, iterations),
      cosines_(iterations),
      sines_(iterations),
      right_side_(iterations + 1) {}

Gmres::Report Gmres::solve(const Operator& apply, const Vector& b, double tolerance, Vector& x) {
  x.setZero(b.size());
  const double size = b.norm();
  if (size == 0.0) return {};
  basis_.resize(b.size(), max_iterations_ + 1);
  right_side_.setZero();
  right_side_(0) = size;
  basis_.col(0) = b / size;
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
    for (int i = 0; i < k; ++i) {
      const double upper = hessenberg_(i, k), lower = hessenberg_(i + 1, k);
      hessenberg_(i, k) = cosines_(i) * upper + sines_(i) * lower;
      hessenberg_(i + 1, k) = cosines_(i) * lower - sines_(i) * upper;
    }
    const double diagonal = std::hypot(hessenberg_(k, k), length);
    cosines_(k) = hessenberg_(k, k) / diagonal;
    sines_(k) = length / diagonal;
    hessenberg_(k, k) = diagonal;
    right_side_(k + 1) = -sines_(k) * right_side_(k);
    right_side_(k) *= cosines_(k);
    residual = std::abs(right_side_(k + 1)) / size;
    ++k;
  }
  for (int i = k - 1; i >= 0; --i) {
    double sum = right_side_(i);
    for (int j = i + 1; j < k; ++j) sum -= hessenberg_(i, j) * cosines_(j);
    cosines_(i) = sum / hessenberg_(i, i);  // from here on the coefficients of the basis
  }
  for (int i = 0; i < k; ++i) x += cosines_(i) * basis_.col(i);
  return {k, residual};
}

}  // namespace vesiflow::coupling
