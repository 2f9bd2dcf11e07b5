// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "vesicle/shapes.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle::testing {

inline Coefficients random_coefficients(int degrees, int fields, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Coefficients coefficients(degrees, fields);
  for (int field = 0; field < fields; ++field)
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) coefficients(field, n, m) = {uniform(generator), m > 0 ? uniform(generator) : 0};
  return coefficients;
}

/// Random scalar and vector fields of the given degrees, of size about one.
inline ScalarField smooth_scalar(const SphereGrid& grid, int degrees, unsigned seed) {
  ScalarField field(grid.size());
  SphericalHarmonics(degrees, grid).synthesis(random_coefficients(degrees, 1, seed), field);
  return field / field.abs().maxCoeff();
}

inline VectorField smooth_vector(const SphereGrid& grid, int degrees, unsigned seed) {
  VectorField field(grid.size(), 3);
  SphericalHarmonics(degrees, grid).synthesis(random_coefficients(degrees, 3, seed), field);
  return field / field.abs().maxCoeff();
}

inline VectorField cross(const Vector3& omega, const VectorField& x) {
  VectorField result(x.rows(), 3);
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const Vector3 r = x.row(k).matrix().transpose();
    result.row(k) = omega.cross(r).transpose().array();
  }
  return result;
}

/// Calls use(field) with `field` spoilt in one entry, by NaN and by infinities of both signs, and expects each time that it is
/// refused by a std::domain_error that names the marker.
template <class Field, class Use>
void expect_refused_if_not_finite(const Field& field, const Use& use) {
  const Eigen::Index marker = field.rows() / 3, last = field.cols() - 1;
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), double{INFINITY}, -double{INFINITY}}) {
    Field spoilt = field;
    spoilt(marker, last) = wrong;
    try {
      use(spoilt);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const std::domain_error& error) {
      EXPECT_EQ(std::string(error.what()).find("marker " + std::to_string(marker) + " of "), 0u) << error.what();
    }
  }
}

/// r = 1 + exp(-3 Re Y_3^2).
inline VectorField y32_surface(const SphereGrid& grid) {
  VectorField x(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double s = grid.sin_colatitude()[j];
      const double c = grid.cos_colatitude()[j];
      const double phi = grid.longitude(i);
      const double y = 0.25 * std::sqrt(105 / (2 * M_PI)) * std::cos(2 * phi) * s * s * c;
      const double r = 1 + std::exp(-3 * y);
      x.row(grid.index(i, j)) << r * s * std::cos(phi), r * s * std::sin(phi), r * c;
    }
  return x;
}

/// Closed forms on the ellipsoid with semi-axes a, b, c at a point x of it:
///   H = p^3 (a^2 + b^2 + c^2 - |x|^2) / (2 (abc)^2), K = p^4 / (abc)^2, p = (x^2/a^4 + y^2/b^4 +
///   z^2/c^4)^{-1/2}, Lap_Gamma H = Lap H - n . (D^2 H) n - 2 H dH/dn for that extension of H.
struct EllipsoidPoint {
  double mean_curvature, gaussian_curvature, laplacian;

  EllipsoidPoint(const Vector3& semi_axes, const Vector3& x) {
    const Vector3 square = semi_axes.cwiseAbs2();
    const Vector3 inverse = square.cwiseAbs2().cwiseInverse();
    const double d = square.prod();
    const double q = x.cwiseAbs2().dot(inverse);
    const Vector3 q1 = 2 * x.cwiseProduct(inverse);
    const Eigen::Matrix3d q2 = (2 * inverse).asDiagonal();
    const double u = std::pow(q, -1.5);
    const Vector3 u1 = -1.5 * std::pow(q, -2.5) * q1;
    const Eigen::Matrix3d u2 = 3.75 * std::pow(q, -3.5) * q1 * q1.transpose() - 1.5 * std::pow(q, -2.5) * q2;
    const double v = square.sum() - x.squaredNorm();
    const Vector3 v1 = -2 * x;
    const Vector3 h1 = (u * v1 + v * u1) / (2 * d);
    const Eigen::Matrix3d h2 =
        (-2 * u * Eigen::Matrix3d::Identity() + u1 * v1.transpose() + v1 * u1.transpose() + v * u2) / (2 * d);
    const Vector3 n = x.cwiseQuotient(square).normalized();
    mean_curvature = u * v / (2 * d);
    gaussian_curvature = 1 / (q * q * d);
    laplacian = h2.trace() - n.dot(h2 * n) - 2 * mean_curvature * n.dot(h1);
  }
};

/// Value at a point of the expansion of one field, by direct summation with the standard library's functions.
inline double point_value(const Coefficients& coefficients, double theta, double phi) {
  double sum = 0;
  for (int n = 0; n < coefficients.degrees(); ++n)
    for (int m = 0; m <= n; ++m) {
      const double p = (m % 2 ? -1 : 1) * std::sph_legendre(unsigned(n), unsigned(m), theta);
      const std::complex<double> c = coefficients(0, n, m);
      sum += (m == 0 ? 1 : 2) * p * (c.real() * std::cos(m * phi) - c.imag() * std::sin(m * phi));
    }
  return sum;
}

/// dE/ds at s = 0 of E(x + s direction) by fourth-order central differences.
template <class Energy>
double directional_derivative(const Energy& energy, const VectorField& x, const VectorField& direction, double step) {
  const auto slope = [&](double s) { return energy(x + s * direction) - energy(x - s * direction); };
  return (8 * slope(step) - slope(2 * step)) / (12 * step);
}

/// int F . direction dA.
inline double work(const Surface& surface, const VectorField& force, const VectorField& direction) {
  return surface.integral(ScalarField((force * direction).rowwise().sum()));
}

}  // namespace vesiflow::vesicle::testing
