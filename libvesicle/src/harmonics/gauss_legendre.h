// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace vesiflow::vesicle {

/// Gauss-Legendre quadrature in colatitude: nodes theta_j, ascending in (0, pi), and weights w_j summing
/// to 2.
struct GaussLegendre {
  std::vector<long double> colatitude;
  std::vector<long double> weight;
};

GaussLegendre gauss_legendre(int nodes);

}  // namespace vesiflow::vesicle
