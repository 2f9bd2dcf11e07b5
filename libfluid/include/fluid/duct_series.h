// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "fluid/export.h"

namespace vesiflow::fluid {

/// The exact solution of steady flow along x in the rectangular duct |y| <= d, |z| <= e (Eq. 35 of the paper), with
/// largest velocity 1 on the axis and viscosity 1:
///
///     u = w(y, z) / w(0, 0),   a = i pi / (2 d),   -Lap w = 1,
///     w = (16 d^2 / pi^3) sum over odd i of (-1)^((i-1)/2) / i^3 [1 - cosh(a z) / cosh(a e)] cos(a y)
///
/// The part without z is pi^3/32 (1 - y^2/d^2) and is taken as that; the rest converges like exp(-a (e - |z|)) / i^3.
/// As w is the same with y, d and z, e exchanged, the form that converges faster at (y, z) is taken. Terms are added
/// until they are below 1e-17 of the first, at most to i = 20001: that leaves less than 1e-14 farther than 1e-3 max(d,
/// e) from an edge, and less than 1e-9 anywhere. The paper stops the plain series at i = 199, with an error of up to
/// 1e-6.
class VESIFLOW_FLUID_EXPORT DuctSeries {
 public:
  /// \param d half-width along y.
  /// \param e half-width along z.
  /// \throws std::invalid_argument unless both half-widths are finite and > 0.
  DuctSeries(double d, double e);

  /// u; zero on the walls and outside.
  double velocity(double y, double z) const;
  /// -dp/dx = -Lap u, the uniform body force that drives the same flow.
  double pressure_gradient() const { return 1 / axis_; }

 private:
  double d_, e_, axis_;  // axis_ = w(0, 0)
};

}  // namespace vesiflow::fluid
