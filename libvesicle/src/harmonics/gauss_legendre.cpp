// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "harmonics/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace vesiflow::vesicle {
namespace {

struct LegendreValue {
  long double value;       ///< P_n(cos theta)
  long double derivative;  ///< dP_n(cos theta)/dtheta
};

LegendreValue legendre(int n, long double theta) {
  const long double x = std::cos(theta);
  long double previous = 1;
  long double current = x;
  for (int k = 2; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (x * current - previous) / std::sin(theta)};
}

}  // namespace

GaussLegendre gauss_legendre(int nodes) {
  constexpr long double pi = std::numbers::pi_v<long double>;
  constexpr int max_iterations = 20;
  constexpr long double tolerance = 1e-18L;
  GaussLegendre rule{std::vector<long double>(nodes), std::vector<long double>(nodes)};
  for (int j = 0; j < (nodes + 1) / 2; ++j) {
    // Tricomi's estimate is within the quadratic basin for every node.
    const long double shrink = 1 - 1.0L / (8.0L * nodes * nodes) + 1.0L / (8.0L * nodes * nodes * nodes);
    long double theta = std::acos(shrink * std::cos(pi * (4 * j + 3) / (4 * nodes + 2)));
    for (int iteration = 0; iteration < max_iterations; ++iteration) {
      const LegendreValue p = legendre(nodes, theta);
      const long double step = p.value / p.derivative;
      theta -= step;
      if (std::abs(step) < tolerance) break;
    }
    if (2 * j + 1 == nodes) theta = pi / 2;
    const long double slope = legendre(nodes, theta).derivative;
    rule.colatitude[j] = theta;
    rule.colatitude[nodes - 1 - j] = pi - theta;
    rule.weight[j] = rule.weight[nodes - 1 - j] = 2 / (slope * slope);
  }
  return rule;
}

}  // namespace vesiflow::vesicle
