// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A flow in closed form whose divergence is not zero, and the force that drives it.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "fluid/grid.h"

namespace vesiflow::fluid::test {

// On [-1,1]^3, which it repeats after: a sum of plane waves along and across their wave vectors,
//   u = sum_m a_m cos(k_m.r + b_m) f_m(t),   div u = -sum_m (a_m.k_m) sin(k_m.r + b_m) f_m(t),   p = sin(k.r + 0.4) g(t).
// Nothing in it is symmetric, and the flux through the faces of the box is zero.
struct FlowWithDivergence {
  double reynolds_number = 1.0;

  Vector3 velocity(const Vector3& r, double t) const {
    Vector3 u{};
    for (const Wave& wave : waves)
      for (int i = 0; i < 3; ++i) u[i] += wave.a[i] * std::cos(wave.phase(r)) * wave.factor(t);
    return u;
  }

  double divergence(const Vector3& r, double t) const {
    double sum = 0.0;
    for (const Wave& wave : waves) sum -= dot(wave.a, wave.k) * std::sin(wave.phase(r)) * wave.factor(t);
    return sum;
  }

  double pressure(const Vector3& r, double t) const { return std::sin(pressure_phase(r)) * pressure_factor(t); }

  // grad p - Lap u: viscosity 1, and the viscous term as the Laplacian.
  Vector3 stokes_force(const Vector3& r, double t) const {
    Vector3 f{};
    for (int i = 0; i < 3; ++i) f[i] = pressure_wave[i] * std::cos(pressure_phase(r)) * pressure_factor(t);
    for (const Wave& wave : waves)
      for (int i = 0; i < 3; ++i) f[i] += dot(wave.k, wave.k) * wave.a[i] * std::cos(wave.phase(r)) * wave.factor(t);
    return f;
  }

  // grad p - div(mu (grad u + grad u^T)) for the viscosity below: the viscous term as the stress.
  Vector3 stress_force(const Vector3& r, double t) const {
    const auto gradient = velocity_gradient(r, t);
    const double mu = viscosity(r);
    const Vector3 slope = viscosity_gradient(r);
    Vector3 f{};
    for (int i = 0; i < 3; ++i) {
      f[i] = pressure_wave[i] * std::cos(pressure_phase(r)) * pressure_factor(t);
      for (const Wave& wave : waves)  // mu (Lap u + grad div u)
        f[i] += mu * (dot(wave.k, wave.k) * wave.a[i] + dot(wave.a, wave.k) * wave.k[i]) * std::cos(wave.phase(r)) *
                wave.factor(t);
      for (int j = 0; j < 3; ++j) f[i] -= slope[j] * (gradient[i][j] + gradient[j][i]);
    }
    return f;
  }
  double viscosity(const Vector3& r) const { return 2.0 + std::sin(viscosity_phase(r)); }

  // Re (du/dt + 1/2 (u.grad)u + 1/2 div(uu)) beside stokes_force(): what convection() is where div u is not zero.
  Vector3 force(const Vector3& r, double t) const {
    Vector3 f = stokes_force(r, t);
    const Vector3 u = velocity(r, t);
    const auto gradient = velocity_gradient(r, t);
    for (const Wave& wave : waves)
      for (int i = 0; i < 3; ++i) f[i] += reynolds_number * wave.a[i] * std::cos(wave.phase(r)) * wave.factor_slope(t);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) f[i] += reynolds_number * u[j] * gradient[i][j];
      f[i] += 0.5 * reynolds_number * u[i] * divergence(r, t);
    }
    return f;
  }

 private:
  static double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  struct Wave {
    Vector3 a, k;
    double b, rate;

    double phase(const Vector3& r) const { return dot(k, r) + b; }
    double factor(double t) const { return std::cos(rate * t + b); }
    double factor_slope(double t) const { return -rate * std::sin(rate * t + b); }
  };

  // [i][j] = d u_i / d x_j.
  std::array<Vector3, 3> velocity_gradient(const Vector3& r, double t) const {
    std::array<Vector3, 3> gradient{};
    for (const Wave& wave : waves)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) gradient[i][j] -= wave.a[i] * wave.k[j] * std::sin(wave.phase(r)) * wave.factor(t);
    return gradient;
  }

  static constexpr double pi = std::numbers::pi;
  static constexpr std::array<Wave, 3> waves{{{{0.7, -0.2, 0.4}, {pi, pi, 0.0}, 0.3, 1.0},
                                              {{-0.3, 0.5, 0.6}, {0.0, pi, -pi}, 1.1, -1.3},
                                              {{0.2, 0.8, -0.5}, {pi, 0.0, 2 * pi}, -0.8, 0.7}}};
  static constexpr Vector3 pressure_wave{pi, -pi, pi};
  static double pressure_phase(const Vector3& r) { return dot(pressure_wave, r) + 0.4; }
  static double pressure_factor(double t) { return 2.0 * std::cos(0.9 * t - 0.5); }
  static constexpr Vector3 viscosity_wave{pi, 0.0, -pi};
  static double viscosity_phase(const Vector3& r) { return dot(viscosity_wave, r) - 0.6; }
  static Vector3 viscosity_gradient(const Vector3& r) {
    const double slope = std::cos(viscosity_phase(r));
    return {slope * viscosity_wave[0], slope * viscosity_wave[1], slope * viscosity_wave[2]};
  }
};

}  // namespace vesiflow::fluid::test
