// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "coupling/delta_kernel.h"

namespace vesiflow::coupling {

/// How a membrane's velocity answers to its forces within one time step, per degree n of the spherical harmonics, in
/// the approximation of a plane sheet: a force per area on a sheet in a viscous fluid that obeys a u - mu Lap u +
/// grad p = f (a = Re times the leading coefficient of the time derivative; 0 without inertia), spread and
/// interpolated with a delta function that is taken as a Gaussian across the sheet, of its second moments m h^2
/// there. With k = (n + 1/2)/R and the wavenumber q = (k, k_z):
///   along   = 1/(2 pi) int g^2 k_z^2 / (q^2 (a + mu q^2)) dk_z   velocity per force along the sheet (gradient part)
///   normal  = 1/(2 pi) int g^2 k^2   / (q^2 (a + mu q^2)) dk_z   velocity per force normal to it, g^2 = exp(-m h^2 k_z^2)
/// (1/(4 mu k) both, for a = h = 0), each with its own m. Within the sheet the delta function takes another exp(-0.1
/// (k h)^2), as was seen by trial; the second moment of the kernels would give more, and then modes of k h of 2 to 3
/// were underestimated and unstable.
///
/// A sharp membrane reads more than that where a step's layer, sqrt(mu/a) thick, is thinner than a cell. What
/// interpolation adds for the kink of a velocity u at the distance d, |d| F/2 along a force F (SharpTransfer), takes it
/// to go on straight from one point to the next, and the layer ends before. The answer of one step is then that of the
/// reading,
///   along:  <u_t(|d|) + |d|/2 + k^2 |d|^3/6>,   u_t(d) = (m exp(-m d) - k exp(-k d))/(2 a),   m^2 = k^2 + a/mu
///   normal: <u_n(|d|) - k^2 |d|^3/12>,          u_n(d) = (k exp(-k d) - k^2/m exp(-m d))/(2 a)
/// (mu = 1), <> being the interpolation by 4 points, in the mean over all positions of the sheet: .12 h along for long
/// waves however short the step is, as against 1/(2 sqrt(a)) in truth. The larger of the two is taken. It varies: on
/// points of the grid the reading adds nothing, between two of them it is 3/16 h and the largest in all orientations.
///
/// What a fluid that carries part of its operator explicitly remembers of a velocity is -d(log response)/da for its
/// time derivative (`inertia`) and -d(log response)/d mu for its viscous term (`viscosity`), both times exp(0.1 (k
/// h)^2), as the true response is weaker than `velocity` by about exp(-0.25 (k h)^2). Units: lengths of the simulation, mu
/// of the outer fluid.
class MembraneResponse {
 public:
  struct Mode {
    struct Answer {
      double velocity = 0.0, inertia = 0.0, viscosity = 0.0;
    };
    Answer along, normal;
  };

  /// m for forces along the sheet and normal to it; 0 for a thin membrane.
  struct SecondMoments {
    double along = 0.0, normal = 0.0;
  };

  /// Those of a kernel, in the mean over the orientations of the sheet. With m_n of the function that a component has
  /// along itself and m_t of that across, a component i has the second moment m_t + (m_n - m_t) n_i^2 across a sheet
  /// of normal n, and a part f_i^2 of a force along f: m = m_t + (m_n - m_t) sum f_i^2 n_i^2, and the mean of the sum
  /// is 3/5 for f = n and 1/5 for f normal to n.
  static SecondMoments second_moments(DeltaKernel kernel);

  /// \param radius of the sphere of the membrane's area
  /// \param is_sharp whether there is no delta function, which takes nothing off within the sheet either, but points of
  /// a grid of that spacing
  MembraneResponse(int degrees, double radius, double spacing, const SecondMoments& moments, bool is_sharp = false);

  /// Recomputes the modes if a or mu has changed.
  void update(double a, double mu);

  const Mode& operator[](int degree) const { return modes_[static_cast<std::size_t>(degree)]; }
  int degrees() const { return static_cast<int>(modes_.size()); }
  double wavenumber(int degree) const { return (degree + 0.5) / radius_; }

 private:
  double radius_, spacing_;
  SecondMoments moments_;
  bool is_sharp_;
  double a_ = -1.0, mu_ = 0.0;
  std::vector<Mode> modes_;
};

}  // namespace vesiflow::coupling
