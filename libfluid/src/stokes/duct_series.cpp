// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/duct_series.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "message.h"

namespace vesiflow::fluid {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int last_term = 20001;
constexpr double smallest_term = 1e-17;

// cosh(a z) / cosh(a e) for 0 <= z <= e, without overflow.
double cosh_ratio(double a, double z, double e) {
  return std::exp(a * (z - e)) * (1 + std::exp(-2 * a * z)) / (1 + std::exp(-2 * a * e));
}

// w for 0 <= y < d, 0 <= z < e.
double solution(double y, double z, double d, double e) {
  if ((e - z) / d < (d - y) / e) {
    std::swap(y, z);
    std::swap(d, e);
  }
  double sum = 0;
  double sign = 1;
  for (int i = 1; i <= last_term; i += 2, sign = -sign) {
    const double a = i * pi / (2 * d);
    const double size = cosh_ratio(a, z, e) / (static_cast<double>(i) * i * i);
    sum += sign * size * std::cos(a * y);
    if (size < smallest_term) break;
  }
  return 0.5 * (d - y) * (d + y) - 16 * d * d / (pi * pi * pi) * sum;
}

}  // namespace

DuctSeries::DuctSeries(double d, double e) : d_(d), e_(e), axis_(0) {
  if (!(std::isfinite(d) && std::isfinite(e) && d > 0 && e > 0))
    throw std::invalid_argument(message("duct: half-widths are ", d, " and ", e, "; they must be finite and > 0"));
  axis_ = solution(0, 0, d, e);
}

double DuctSeries::velocity(double y, double z) const {
  y = std::abs(y);
  z = std::abs(z);
  if (y >= d_ || z >= e_) return 0;
  return solution(y, z, d_, e_) / axis_;
}

}  // namespace vesiflow::fluid
