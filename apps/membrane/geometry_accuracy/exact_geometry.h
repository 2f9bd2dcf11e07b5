// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "jet.h"

template <class Number>
using Point = std::array<Number, 3>;

/// Curvatures of a surface at one of its points, in the sign of vesicle/surface_geometry.h.
struct PointGeometry {
  long double mean_curvature;
  long double gaussian_curvature;
  long double curvature_laplacian;   ///< Lap_Gamma H
  long double area_per_solid_angle;  ///< |X_theta x X_phi| / sin(theta)
};

namespace exact_geometry_detail {

template <int Order>
Jet<Order> dot(const Point<Jet<Order>>& a, const Point<Jet<Order>>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <int Order>
Point<Jet<Order>> cross(const Point<Jet<Order>>& a, const Point<Jet<Order>>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int Order>
Point<Jet<Order - 1>> du(const Point<Jet<Order>>& a) {
  return {a[0].du(), a[1].du(), a[2].du()};
}

template <int Order>
Point<Jet<Order - 1>> dv(const Point<Jet<Order>>& a) {
  return {a[0].dv(), a[1].dv(), a[2].dv()};
}

template <int Lower, int Order>
Point<Jet<Lower>> truncated(const Point<Jet<Order>>& a) {
  return {a[0].template truncated<Lower>(), a[1].template truncated<Lower>(), a[2].template truncated<Lower>()};
}

}  // namespace exact_geometry_detail

/// Geometry of X(u, v) at u = v = 0, exact up to the rounding of long double. X_u x X_v must point outward. The area is per
/// unit of u and v.
inline PointGeometry geometry_of_patch(const Point<Jet<4>>& x) {
  using namespace exact_geometry_detail;
  const Point<Jet<3>> xu = du(x), xv = dv(x);
  const Jet<3> e = dot(xu, xu), f = dot(xu, xv), g = dot(xv, xv);
  const Point<Jet<2>> xu2 = truncated<2>(xu), xv2 = truncated<2>(xv);
  const Point<Jet<2>> normal = cross(xu2, xv2);  // of length w
  const Jet<2> w = sqrt(dot(normal, normal));
  const Jet<2> l = dot(du(xu), normal), m = dot(dv(xu), normal), n = dot(dv(xv), normal);  // each times w
  const Jet<2> e2 = e.truncated<2>(), f2 = f.truncated<2>(), g2 = g.truncated<2>();
  const Jet<2> mean = (2 * f2 * m - g2 * l - e2 * n) / (2 * w * w * w);
  const Jet<1> hu = mean.du(), hv = mean.dv();
  const Jet<1> e1 = e.truncated<1>(), f1 = f.truncated<1>(), g1 = g.truncated<1>(), w1 = w.truncated<1>();
  const long double flux = ((g1 * hu - f1 * hv) / w1).du().value() + ((e1 * hv - f1 * hu) / w1).dv().value();
  const long double w0 = w.value();
  return {.mean_curvature = mean.value(),
          .gaussian_curvature = (l.value() * n.value() - m.value() * m.value()) / (w0 * w0 * w0 * w0),
          .curvature_laplacian = flux / w0,
          .area_per_solid_angle = w0};
}

/// Geometry where the surface meets the given direction of the parameter sphere. `surface` takes a unit vector
/// (sin(theta) cos(phi), sin(theta) sin(phi), cos(theta)) of jets to the position.
///
/// The parameters are the direction's displacements along the meridian and the parallel, projected to the sphere:
/// curvatures do not depend on the parameters, and these are as good at the poles as elsewhere.
template <class Surface>
PointGeometry exact_geometry(const Surface& surface, long double sin_theta, long double cos_theta, long double phi) {
  const long double c = std::cos(phi), s = std::sin(phi);
  const long double r = std::hypot(sin_theta, cos_theta);  // of a rounded sine and cosine
  sin_theta /= r;
  cos_theta /= r;
  const Point<long double> direction = {sin_theta * c, sin_theta * s, cos_theta};
  const Point<long double> south = {cos_theta * c, cos_theta * s, -sin_theta};
  const Point<long double> east = {-s, c, 0};
  const Jet<4> u = Jet<4>::u(), v = Jet<4>::v();
  const Jet<4> shrink = Jet<4>(1) / sqrt(Jet<4>(1) + u * u + v * v);
  Point<Jet<4>> sphere;
  for (int k = 0; k < 3; ++k) sphere[k] = (Jet<4>(direction[k]) + south[k] * u + east[k] * v) * shrink;
  return geometry_of_patch(surface(sphere));
}
