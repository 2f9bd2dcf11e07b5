// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vesiflow::coupling {

/// BDF2 for steps of any length in the increments d^{k+1} = y^{k+1} - y^k of dy/dt = f:
///   a0 d^{k+1} = a1 d^k + dt f,   a0 = (1 + 2r)/(1 + r),   a1 = r^2/(1 + r),   r = dt over the last dt.
/// Without a last step r is 0, and this is backward Euler. The state extrapolated to the new time is y* = y^k + r d^k.
struct Bdf2 {
  double ratio = 0.0;    // r
  double leading = 1.0;  // a0
  double last = 0.0;     // a1

  /// \param last_dt 0 before the first step
  static Bdf2 of(double dt, double last_dt) {
    const double r = last_dt > 0.0 ? dt / last_dt : 0.0;
    return {r, (1.0 + 2.0 * r) / (1.0 + r), r * r / (1.0 + r)};
  }
};

}  // namespace vesiflow::coupling
