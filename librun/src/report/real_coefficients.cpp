// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/real_coefficients.h"

#include <cmath>
#include <numbers>

namespace vesiflow::run {

RealCoefficients real_coefficients(const vesicle::Coefficients& coefficients, int degrees) {
  constexpr double root = std::numbers::sqrt2;
  RealCoefficients real(degrees * degrees, coefficients.fields());
  for (int f = 0; f < coefficients.fields(); ++f)
    for (int n = 0; n < degrees; ++n) {
      real(n * n, f) = static_cast<float>(coefficients(f, n, 0).real());
      for (int m = 1; m <= n; ++m) {
        real(n * n + 2 * m - 1, f) = static_cast<float>(root * coefficients(f, n, m).real());
        real(n * n + 2 * m, f) = static_cast<float>(-root * coefficients(f, n, m).imag());
      }
    }
  return real;
}

vesicle::Coefficients complex_coefficients(const RealCoefficients& real) {
  constexpr double root = std::numbers::sqrt2;
  const int degrees = static_cast<int>(std::lround(std::sqrt(static_cast<double>(real.rows()))));
  vesicle::Coefficients coefficients(degrees, static_cast<int>(real.cols()));
  for (int f = 0; f < coefficients.fields(); ++f)
    for (int n = 0; n < degrees; ++n) {
      coefficients(f, n, 0) = static_cast<double>(real(n * n, f));
      for (int m = 1; m <= n; ++m)
        coefficients(f, n, m) = {static_cast<double>(real(n * n + 2 * m - 1, f)) / root,
                                 static_cast<double>(-real(n * n + 2 * m, f)) / root};
    }
  return coefficients;
}

}  // namespace vesiflow::run
