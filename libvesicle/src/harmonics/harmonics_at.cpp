// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/harmonics_at.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace vesiflow::vesicle {
namespace {

Eigen::Index unknown(int n, int m) {
  return Eigen::Index{n} * n + (m == 0 ? 0 : 2 * m - 1);
}

}  // namespace

void harmonics_at(const Vector3& direction, int degrees, Eigen::Ref<Eigen::VectorXd> values) {
  const double x = direction.z();
  const double s = std::hypot(direction.x(), direction.y());
  // At a pole every order but 0 vanishes, whatever the longitude.
  const std::complex<double> turn = s > 0 ? std::complex(direction.x() / s, direction.y() / s) : 1;
  std::complex<double> phase = 1;
  double diagonal = 1 / std::sqrt(4 * std::numbers::pi);
  for (int m = 0; m < degrees; ++m) {
    if (m > 0) {
      phase *= turn;
      diagonal *= s * std::sqrt((2.0 * m + 1) / (2.0 * m));
    }
    double before = 0;
    double p = diagonal;
    for (int n = m; n < degrees; ++n) {
      const Eigen::Index k = unknown(n, m);
      if (m == 0) {
        values[k] = p;
      } else {
        values[k] = 2 * p * phase.real();
        values[k + 1] = -2 * p * phase.imag();
      }
      const double up = n + 1.0;
      const double a = std::sqrt((4 * up * up - 1) / (up * up - double(m) * m));
      const double b = std::sqrt((double(n) * n - double(m) * m) / (4.0 * n * n - 1));
      const double next = a * (x * p - b * before);
      before = p;
      p = next;
    }
  }
}

Coefficients coefficients_of(const Eigen::VectorXd& unknowns, int degrees) {
  Coefficients coefficients(degrees, 1);
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m <= n; ++m) {
      const Eigen::Index k = unknown(n, m);
      coefficients(0, n, m) = {unknowns[k], m == 0 ? 0 : unknowns[k + 1]};
    }
  return coefficients;
}

}  // namespace vesiflow::vesicle
