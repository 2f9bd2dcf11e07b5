// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "vesicle/coefficients.h"

namespace vesiflow::vesicle {

/// Multiplies the coefficients of each degree n, of all orders, by a number: factor(n) for all fields alike, or
/// factor(field, n). It is asked once for each degree, or field and degree.
template <class Factor>
void scale_degrees(Coefficients& coefficients, const Factor& factor) {
  for (int n = 0; n < coefficients.degrees(); ++n) {
    if constexpr (std::is_invocable_v<const Factor&, int, int>) {
      for (int field = 0; field < coefficients.fields(); ++field) {
        const double scale = factor(field, n);
        for (int m = 0; m <= n; ++m) coefficients(field, n, m) *= scale;
      }
    } else {
      const double scale = factor(n);
      for (int m = 0; m <= n; ++m)
        for (int field = 0; field < coefficients.fields(); ++field) coefficients(field, n, m) *= scale;
    }
  }
}

}  // namespace vesiflow::vesicle
