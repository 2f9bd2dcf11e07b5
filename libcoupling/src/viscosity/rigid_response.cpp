// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/rigid_response.h"

#include <Eigen/Dense>
#include <cmath>

namespace vesiflow::coupling {

// R = 1, a = k^2. Potential parts are grad p/a, with p = P z inside and Q z/r^3 outside; the rest is curl curl (e g) of a translation along e,
// g = sinh(kr)/r inside and exp(-kr)/r outside, and e x x g'/r of a rotation. For w = (U cos, -V sin) incompressibility and the continuous
// traction leave [U] = [V] = q, [V'] = 0, P = Q. With g = 1 on the sphere and s = g' there, g'' = k^2 - 2 s.
RigidResponse rigid_response(double a_r2) {
  const double k = std::sqrt(a_r2);
  if (k < 1e-2) return {-0.5, -0.5};  // to k^2/4, and the equations become singular
  const double in = k / std::tanh(k) - 1.0, out = -k - 1.0, kk = a_r2;
  // Unknowns: P/a, amplitude inside, amplitude outside.
  Eigen::Matrix3d equations;
  equations << 3.0, 2.0 * in, -2.0 * out,  //
      0.0, -(in - kk), out - kk,           //
      3.0, -(kk - 3.0 * in - kk * in), kk - 3.0 * out - kk * out;
  const Eigen::Vector3d x = equations.partialPivLu().solve(Eigen::Vector3d(1.0, 1.0, 0.0));
  const double radial = 0.5 * ((-x[0] - 2.0 * in * x[1]) + (2.0 * x[0] - 2.0 * out * x[2]));
  const double along = 0.5 * ((-x[0] + (in - kk) * x[1]) + (-x[0] + (out - kk) * x[2]));
  const double rate_in = (kk - 3.0 * in) / in, rate_out = (kk - 3.0 * out) / out;
  return {(radial + 2.0 * along) / 3.0, 0.5 * (rate_in + rate_out) / (rate_in - rate_out)};
}

}  // namespace vesiflow::coupling
