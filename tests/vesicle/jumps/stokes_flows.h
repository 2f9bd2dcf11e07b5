// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <utility>
#include <vector>

#include "vesicle/types.h"

namespace vesiflow::vesicle::testing {

/// Taylor series in one variable to the third power: values and derivatives along a line to round-off.
struct Taylor {
  std::array<double, 4> c{};

  Taylor() = default;
  Taylor(double value, double slope = 0) : c{value, slope, 0, 0} {}

  /// d^k/dt^k at 0.
  double derivative(int k) const { return (k < 2 ? 1 : k == 2 ? 2 : 6) * c[std::size_t(k)]; }

  friend Taylor operator+(Taylor a, const Taylor& b) {
    for (std::size_t i = 0; i < 4; ++i) a.c[i] += b.c[i];
    return a;
  }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    Taylor r;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; i + j < 4; ++j) r.c[i + j] += a.c[i] * b.c[j];
    return r;
  }
  friend Taylor operator-(const Taylor& a) { return a * -1.0; }
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + -b; }

  /// a^s: r' a = s r a'.
  friend Taylor pow(const Taylor& a, double s) {
    Taylor r;
    r.c[0] = std::pow(a.c[0], s);
    for (std::size_t n = 1; n < 4; ++n) {
      for (std::size_t k = 1; k <= n; ++k) r.c[n] += (s * double(k) - double(n - k)) * a.c[k] * r.c[n - k];
      r.c[n] /= double(n) * a.c[0];
    }
    return r;
  }
};

using TaylorVector = std::array<Taylor, 3>;

inline TaylorVector operator+(const TaylorVector& a, const TaylorVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline TaylorVector operator*(const Taylor& s, const TaylorVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline Taylor dot(const TaylorVector& a, const TaylorVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline TaylorVector cross(const TaylorVector& a, const TaylorVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline TaylorVector constant(const Vector3& v) {
  return {v[0], v[1], v[2]};
}
/// x + t direction.
inline TaylorVector line(const Vector3& x, const Vector3& direction) {
  return {Taylor(x[0], direction[0]), Taylor(x[1], direction[1]), Taylor(x[2], direction[2])};
}

/// Velocity and pressure of a Stokes flow of viscosity 1.
struct FlowValue {
  TaylorVector velocity{};
  Taylor pressure;
};

using Flow = std::function<FlowValue(const TaylorVector&)>;

inline Flow operator+(const Flow& a, const Flow& b) {
  return [a, b](const TaylorVector& x) {
    const FlowValue u = a(x), v = b(x);
    return FlowValue{u.velocity + v.velocity, u.pressure + v.pressure};
  };
}
inline Flow operator*(double s, const Flow& a) {
  return [s, a](const TaylorVector& x) {
    const FlowValue u = a(x);
    return FlowValue{s * u.velocity, s * u.pressure};
  };
}
/// R u(R^T (x - shift)): the flow turned and moved along.
inline Flow moved(const Flow& flow, const Eigen::Matrix3d& rotation, const Vector3& shift) {
  const auto turned = [](const Eigen::Matrix3d& m, const TaylorVector& v) {
    TaylorVector r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r[std::size_t(i)] = r[std::size_t(i)] + m(i, j) * v[std::size_t(j)];
    return r;
  };
  return [=](const TaylorVector& x) {
    FlowValue u = flow(turned(rotation.transpose(), x + constant(-shift)));
    u.velocity = turned(rotation, u.velocity);
    return u;
  };
}

/// u = f / r + r (f . r) / r^3, p = 2 f . r / r^3: a point force 8 pi f.
inline Flow stokeslet(const Vector3& pole, const Vector3& f) {
  return [=](const TaylorVector& x) {
    const TaylorVector r = x + constant(-pole);
    const Taylor square = dot(r, r), fr = dot(r, constant(f));
    return FlowValue{pow(square, -0.5) * constant(f) + (fr * pow(square, -1.5)) * r, 2.0 * fr * pow(square, -1.5)};
  };
}

/// u = r (a . r) (b . r) / r^5 - r (a . b) / (3 r^3), the stresslet of a and b without its rotation and source.
inline Flow stresslet(const Vector3& pole, const Vector3& a, const Vector3& b) {
  return [=](const TaylorVector& x) {
    const TaylorVector r = x + constant(-pole);
    const Taylor square = dot(r, r), product = dot(r, constant(a)) * dot(r, constant(b));
    const double ab = a.dot(b);
    return FlowValue{(product * pow(square, -2.5) - ab / 3 * pow(square, -1.5)) * r,
                     2.0 * product * pow(square, -2.5) - 2.0 / 3 * ab * pow(square, -1.5)};
  };
}

/// u = r / r^3.
inline Flow source(const Vector3& pole) {
  return [=](const TaylorVector& x) {
    const TaylorVector r = x + constant(-pole);
    return FlowValue{pow(dot(r, r), -1.5) * r, {}};
  };
}

/// u = a (b . x)^2 with a . b = 0, p = 2 |b|^2 a . x.
inline Flow parabolic(const Vector3& a, const Vector3& b) {
  return [=](const TaylorVector& x) {
    const Taylor bx = dot(x, constant(b));
    return FlowValue{(bx * bx) * constant(a), 2 * b.squaredNorm() * dot(x, constant(a))};
  };
}

/// A solid harmonic and its gradient.
struct SolidHarmonic {
  Taylor value;
  TaylorVector gradient;
};

/// Re (b . x)^n with a complex null vector b, b . b = 0: a harmonic polynomial of degree n, without symmetry for a
/// general b = e + i f of orthogonal e and f of the same length; over r^{2n+1} if outside.
inline SolidHarmonic solid_harmonic(const Vector3& e, const Vector3& f, int n, bool outside, const TaylorVector& x) {
  const Taylor re = dot(x, constant(e)), im = dot(x, constant(f));
  Taylor power_re = 1, power_im = 0;  // of n - 1
  for (int k = 1; k < n; ++k) {
    const Taylor next = power_re * re - power_im * im;
    power_im = power_re * im + power_im * re;
    power_re = next;
  }
  SolidHarmonic h{power_re * re - power_im * im,
                  (double(n) * power_re) * constant(e) + (-double(n) * power_im) * constant(f)};
  if (!outside) return h;
  const Taylor square = dot(x, x);
  h.gradient = pow(square, -n - 0.5) * h.gradient + (-(2 * n + 1.0) * h.value * pow(square, -n - 1.5)) * x;
  h.value = h.value * pow(square, -n - 0.5);
  return h;
}

/// One term of Lamb's general solution, degree n inside and -(n + 1) outside, with solid harmonics h of the same kind
/// times three amplitudes (H. Lamb, Hydrodynamics, 6th ed., art. 335): with m that degree and p = pressure h,
///
///     u = (m + 3) / (2 (m + 1) (2m + 3)) r^2 grad p - m / ((m + 1) (2m + 3)) x p + grad(potential h) + grad(swirl h) x x.
struct LambTerm {
  Vector3 e, f;
  int n;
  bool outside;
  double pressure, potential, swirl;

  double degree() const { return outside ? -(n + 1) : n; }
  double gradient_factor() const { return (degree() + 3) / (2 * (degree() + 1) * (2 * degree() + 3)); }
  double radial_factor() const { return -degree() / ((degree() + 1) * (2 * degree() + 3)); }

  FlowValue operator()(const TaylorVector& x) const {
    const SolidHarmonic h = solid_harmonic(e, f, n, outside, x);
    const Taylor square = dot(x, x);
    return {(gradient_factor() * pressure * square + potential) * h.gradient +
                (radial_factor() * pressure * h.value) * x + Taylor(swirl) * cross(h.gradient, x),
            pressure * h.value};
  }

  /// The term on the other side with the same velocity on the unit sphere.
  LambTerm continued() const {
    // On the sphere u = R h x + G grad_s h + ...: of the pressure's part and of the potential's part, here and there.
    LambTerm other = *this;
    other.outside = !outside;
    const double r = pressure * (gradient_factor() * degree() + radial_factor()) + potential * degree();
    const double g = pressure * gradient_factor() + potential;
    const double a = other.gradient_factor() * other.degree() + other.radial_factor(), b = other.degree();
    const double c = other.gradient_factor();
    other.pressure = (r - b * g) / (a - b * c);
    other.potential = g - c * other.pressure;
    return other;
  }
};

/// Traction sigma . n of a flow at a point.
inline Vector3 traction(const Flow& flow, const Vector3& x, const Vector3& n) {
  Eigen::Matrix3d gradient;  // gradient(j, i) = d_j u_i
  double pressure = 0;
  for (int j = 0; j < 3; ++j) {
    const FlowValue value = flow(line(x, Vector3::Unit(j)));
    for (int i = 0; i < 3; ++i) gradient(j, i) = value.velocity[std::size_t(i)].derivative(1);
    pressure = value.pressure.derivative(0);
  }
  return -pressure * n + (gradient + gradient.transpose()) * n;
}

}  // namespace vesiflow::vesicle::testing
