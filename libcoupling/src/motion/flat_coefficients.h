// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/coefficients.h"

namespace vesiflow::coupling {

/// Real and imaginary parts of all coefficients as one vector, in the order of their storage.
inline Eigen::Map<Eigen::VectorXd> as_vector(vesicle::Coefficients& c) {
  return {reinterpret_cast<double*>(c.block(0, 0)), Eigen::Index(c.fields()) * c.degrees() * (c.degrees() + 1)};
}
inline Eigen::Map<const Eigen::VectorXd> as_vector(const vesicle::Coefficients& c) {
  return {reinterpret_cast<const double*>(c.block(0, 0)), Eigen::Index(c.fields()) * c.degrees() * (c.degrees() + 1)};
}

/// Calls visit(coefficient, field, degree) for all of them.
template <typename Visit>
void for_each_coefficient(vesicle::Coefficients& c, const Visit& visit) {
  for (int n = 0; n < c.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < c.fields(); ++f) visit(c(f, n, m), f, n);
}

}  // namespace vesiflow::coupling
