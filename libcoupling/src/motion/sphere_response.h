// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "coupling/delta_kernel.h"

namespace vesiflow::coupling {

/// How a spherical membrane of radius R answers to forces in Stokes flow of viscosity 1, per degree n: exactly, and
/// as the immersed boundary method has it, which spreads the force, solves on the grid and interpolates. In the mean
/// over all positions of the sphere on the grid that gives
///   u_i(X) = 1/(2 pi)^3 int S_ij(q) [int F_j(Y) exp(i q.(X - Y)) dA] d^3q,
///   S_ij   = phi_i(q) phi_j(q) (delta_ij - D_i D_j/D^2)/D^2,   D_i = 2/h sin(q_i h/2),
/// phi_i the Fourier transform of the delta function of component i: integrals over all q, not those of the grid
/// only, which is how waves that the grid takes for others are counted. In the mean over all orientations too, S is
/// a(q) (I - qq) + b(q) qq of the unit vectors q, and of the integral over the sphere spherical Bessel functions are
/// left. With
///   e+ = (-(n+1) Y n + R grad Y)/sqrt((n+1)(2n+1)),   e- = (n Y n + R grad Y)/sqrt(n(2n+1))
/// of a spherical harmonic Y of degree n, whose Cartesian components are harmonics of degree n + 1 and n - 1, and
///   t  = (sqrt(n), sqrt(n+1))/sqrt(2n+1),   l = (-sqrt(n+1), sqrt(n))/sqrt(2n+1),   v = (j_{n+1}(qR), -j_{n-1}(qR)),
/// the answer in e_r to a force in e_s is 2 R^2/pi int q^2 v_r v_s (a t_r t_s + b l_r l_s) dq. Exactly, a = 1/q^2 and
/// b = 0: R n/((2n+1)(2n+3)) and R (n+1)/((2n+1)(2n-1)), and nothing mixed.
class SphereResponse {
 public:
  /// Velocity in e+ of a force per area in e+, in e- of one in e-, and in each of one in the other.
  struct Answer {
    double plus = 0.0, minus = 0.0, mixed = 0.0;
  };

  SphereResponse(DeltaKernel kernel, double radius, double spacing);

  /// \param degree 1 or more
  Answer exact(int degree) const;
  Answer immersed(int degree) const;

  /// Of an answer, the normal velocity of a normal force.
  static double normal(int degree, const Answer& answer);

 private:
  double radius_, step_;                    // of the wavenumber q
  std::vector<double> transverse_, along_;  // q^2 a and q^2 b at the midpoints of the steps
};

}  // namespace vesiflow::coupling
