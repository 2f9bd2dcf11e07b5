// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "check.h"
#include "harmonics/directions.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::vesicle {
namespace {

using std::numbers::pi;

void check_placement(const Placement& placement) {
  check_argument(placement.effective_radius > 0 && std::isfinite(placement.effective_radius), "effective_radius",
                 placement.effective_radius, "finite and > 0");
  constexpr double tolerance = 1e-12;
  if (!placement.rotation.isUnitary(tolerance) || !(placement.rotation.determinant() > 0))
    throw std::invalid_argument("rotation: must be a proper rotation matrix");
  if (!placement.centre.allFinite()) throw std::invalid_argument("centre: must be finite");
}

/// x = centre + rotation (scale shape), row by row.
VectorField placed(const VectorField& shape, double scale, const Placement& placement) {
  VectorField positions = (scale * shape.matrix() * placement.rotation.transpose()).array();
  positions.rowwise() += placement.centre.transpose().array();
  return positions;
}

/// The coefficients over a power of two next to the largest: as many digits, and products of them do not overflow.
struct UnitSize {
  Coefficients coefficients;
  int exponent;
};
UnitSize of_unit_size(const Coefficients& coefficients) {
  const auto for_each = [&](auto&& visit) {
    for (int n = 0; n < coefficients.degrees(); ++n)
      for (int m = 0; m <= n; ++m)
        for (int f = 0; f < coefficients.fields(); ++f) visit(f, n, m);
  };
  double largest = 0;
  for_each([&](int f, int n, int m) {
    const auto c = coefficients(f, n, m);
    if (!std::isfinite(c.real()) || !std::isfinite(c.imag()))
      throw std::invalid_argument("surface coefficients: must be finite");
    largest = std::max({largest, std::abs(c.real()), std::abs(c.imag())});
  });
  UnitSize unit{coefficients, largest > 0 ? std::ilogb(largest) : 0};
  for_each([&](int f, int n, int m) {
    const auto c = coefficients(f, n, m);
    unit.coefficients(f, n, m) = {std::ldexp(c.real(), -unit.exponent), std::ldexp(c.imag(), -unit.exponent)};
  });
  return unit;
}

/// (4/3) pi r^3 = volume.
double radius_of_sphere(double volume) {
  return std::cbrt(volume / (4 * pi / 3));
}

/// ln of the aspect ratio with the given reduced volume, between 0 (the sphere) and far_side; the reduced
/// volume falls monotonically from 1 on the way. Bisection: it needs no derivative, which vanishes at the
/// sphere.
double log_aspect_ratio(double reduced_volume, double far_side) {
  check_argument(reduced_volume > 0 && reduced_volume <= 1, "reduced_volume", reduced_volume, "in (0, 1]");
  if (spheroid_reduced_volume(std::exp(far_side)) >= reduced_volume)
    check_argument(false, "reduced_volume", reduced_volume,
                   "larger: no spheroid with an aspect ratio below e^60 is so flat or so slender");
  double near = 0;
  double far = far_side;
  for (double middle = far / 2; middle != near && middle != far; middle = near + (far - near) / 2)
    (spheroid_reduced_volume(std::exp(middle)) >= reduced_volume ? near : far) = middle;
  return near;
}

constexpr double largest_log_aspect_ratio = 60;

/// 1 + sum of the terms.
Coefficients radius_of(std::span<const Harmonic> terms, int largest_degree) {
  int degrees = 1;
  for (const Harmonic& term : terms) {
    if (term.degree < 0 || term.degree > largest_degree)
      throw std::invalid_argument("degree of a harmonic = " + std::to_string(term.degree) + ": must be in [0, " +
                                  std::to_string(largest_degree) + "], the latitudes of the mesh less two");
    if (term.order < -term.degree || term.order > term.degree)
      throw std::invalid_argument("order of a harmonic = " + std::to_string(term.order) +
                                  ": must be in [-n, n], n = " + std::to_string(term.degree) + " its degree");
    check_argument(std::isfinite(term.amplitude), "amplitude of a harmonic", term.amplitude, "finite");
    degrees = std::max(degrees, term.degree + 1);
  }
  Coefficients radius(degrees, 1);
  radius.set_zero();
  radius(0, 0, 0) = std::sqrt(4 * pi);
  for (const auto& [n, m, amplitude] : terms) {
    // The expansion has 2 Re (f Y) = 2 Re f Re Y - 2 Im f Im Y for positive orders.
    if (m == 0) radius(0, n, 0) += amplitude;
    if (m > 0) radius(0, n, m) += amplitude / 2;
    if (m < 0) radius(0, n, -m) -= Coefficients::Complex(0, amplitude / 2);
  }
  return radius;
}

ScalarField positive_radius(const Coefficients& radius, const SphereGrid& grid) {
  ScalarField r(grid.size());
  SphericalHarmonics(radius.degrees(), grid, 1).synthesis(radius, r);
  check_argument(r.minCoeff() > 0, "smallest radius of the perturbed sphere", r.minCoeff(),
                 "> 0; take smaller amplitudes");
  return r;
}

struct EnclosedMoments {
  double volume = 0;
  Vector3 centroid = Vector3::Zero();
};

/// Exact quadrature of (1/3) int X . N and (1/2) int |X|^2 N over the parameter sphere, N = X_theta x X_phi/sin(theta),
/// about the mean of X; with degrees < p they have degrees <= 3 (p - 1) and <= 4 (p - 1).
EnclosedMoments enclosed_moments(const Coefficients& coefficients) {
  const SphereGrid grid(2 * coefficients.degrees());
  const SphericalHarmonics harmonics(coefficients.degrees(), grid);
  VectorField x(grid.size(), 3), x_theta(grid.size(), 3), x_phi(grid.size(), 3);
  harmonics.synthesis(coefficients, x);
  harmonics.gradient(coefficients, x_theta, x_phi);
  const Vector3 origin = x.colwise().mean().matrix().transpose();
  EnclosedMoments moments;
  for (Eigen::Index k = 0; k < grid.size(); ++k) {
    const Vector3 r = x.row(k).matrix().transpose() - origin;
    const Vector3 theta = x_theta.row(k).matrix().transpose();
    const Vector3 normal =
        theta.cross(x_phi.row(k).matrix().transpose()) * grid.parameter_measure()[k / grid.longitudes()];
    moments.volume += r.dot(normal) / 3;
    moments.centroid += r.squaredNorm() / 2 * normal;
  }
  moments.centroid = origin + moments.centroid / moments.volume;
  return moments;
}

}  // namespace

double reduced_volume(double area, double volume) {
  check_argument(std::isfinite(area) && area > 0, "area", area, "finite and > 0");
  check_argument(std::isfinite(volume) && volume > 0, "volume", volume, "finite and > 0");
  return 6 * std::sqrt(pi) * volume / (area * std::sqrt(area));
}

double spheroid_reduced_volume(double aspect_ratio) {
  check_argument(aspect_ratio > 0 && std::isfinite(aspect_ratio), "aspect_ratio", aspect_ratio, "finite and > 0");
  // Area over 2 pi a^2 of the spheroid with equatorial semi-axis a and polar semi-axis c = q a.
  const double q = aspect_ratio;
  double area = 2;
  if (q > 1) {
    const double e = std::sqrt((q - 1) * (q + 1)) / q;
    area = 1 + q / e * std::asin(e);
  } else if (q < 1) {
    const double e = std::sqrt((1 - q) * (1 + q));
    area = 1 + q * q / e * std::asinh(e / q);  // atanh(e), where e may round to 1
  }
  return reduced_volume(2 * pi * area, 4 * pi / 3 * q);
}

double prolate_aspect_ratio(double reduced_volume) {
  return std::exp(log_aspect_ratio(reduced_volume, largest_log_aspect_ratio));
}

double oblate_aspect_ratio(double reduced_volume) {
  return std::exp(log_aspect_ratio(reduced_volume, -largest_log_aspect_ratio));
}

VectorField ellipsoid(const SphereGrid& grid, const Vector3& proportions, const Placement& placement) {
  for (double p : proportions)  // whose product must not overflow
    check_argument(p >= 1e-100 && p <= 1e100, "semi-axis proportion", p, "in [1e-100, 1e100]");
  check_placement(placement);
  VectorField shape(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      shape.row(grid.index(i, j)) = proportions.cwiseProduct(direction(grid, i, j)).transpose().array();
  return placed(shape, placement.effective_radius / std::cbrt(proportions.prod()), placement);
}

VectorField sphere(const SphereGrid& grid, const Placement& placement) {
  return ellipsoid(grid, Vector3::Ones(), placement);
}

VectorField spheroid(const SphereGrid& grid, double aspect_ratio, const Placement& placement) {
  check_argument(aspect_ratio > 0 && std::isfinite(aspect_ratio), "aspect_ratio", aspect_ratio, "finite and > 0");
  return ellipsoid(grid, Vector3(1, 1, aspect_ratio), placement);
}

VectorField prolate(const SphereGrid& grid, double reduced_volume, const Placement& placement) {
  return spheroid(grid, prolate_aspect_ratio(reduced_volume), placement);
}

VectorField oblate(const SphereGrid& grid, double reduced_volume, const Placement& placement) {
  return spheroid(grid, oblate_aspect_ratio(reduced_volume), placement);
}

VectorField biconcave_disc(const SphereGrid& grid, const Placement& placement) {
  check_placement(placement);
  constexpr double c0 = 0.207161, c1 = 2.002558, c2 = -1.122762;
  // int_0^1 4 pi rho z drho, term by term.
  constexpr double volume = 2 * pi * (c0 / 3 + c1 * 2 / 15 + c2 * 8 / 105);
  VectorField shape(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j) {
    const double rho2 = grid.sin_colatitude()[j] * grid.sin_colatitude()[j];
    const Vector3 stretch(1, 1, (c0 + rho2 * (c1 + rho2 * c2)) / 2);
    for (int i = 0; i < grid.longitudes(); ++i)
      shape.row(grid.index(i, j)) = stretch.cwiseProduct(direction(grid, i, j)).transpose().array();
  }
  return placed(shape, placement.effective_radius / radius_of_sphere(volume), placement);
}

VectorField perturbed_sphere(const SphereGrid& grid, std::span<const Harmonic> terms, const Placement& placement) {
  check_placement(placement);
  const Coefficients radius = radius_of(terms, grid.latitudes() - 2);
  // Finer than the volume needs, which has degree 3 (degrees - 1): the smallest radius should be seen too.
  const SphereGrid fine(4 * radius.degrees() + 1);
  const ScalarField r_fine = positive_radius(radius, fine);
  double volume = 0;
  for (int j = 0; j < fine.latitudes(); ++j)
    volume += fine.weight()[j] * fine.longitude_spacing() / 3 *
              r_fine.segment(fine.index(0, j), fine.longitudes()).cube().sum();

  const ScalarField r = positive_radius(radius, grid);
  VectorField shape(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      shape.row(grid.index(i, j)) = r[grid.index(i, j)] * direction(grid, i, j).transpose().array();
  return placed(shape, placement.effective_radius / radius_of_sphere(volume), placement);
}

VectorField shape_from_coefficients(const SphereGrid& grid, const Coefficients& coefficients,
                                    const Placement& placement) {
  check_placement(placement);
  check_argument(coefficients.fields() == 3, "fields of the surface coefficients", coefficients.fields(), "3");
  const auto [unit, exponent] = of_unit_size(coefficients);
  const EnclosedMoments moments = enclosed_moments(unit);
  if (!(moments.volume > 0)) {
    std::ostringstream message;
    message << "surface coefficients: enclosed volume = " << std::ldexp(moments.volume, 3 * exponent)
            << ": must be > 0; a negative one means that X_theta x X_phi points inward: take the complex conjugate of "
               "every coefficient, which reverses the longitude";
    throw std::domain_error(message.str());
  }
  VectorField shape(grid.size(), 3);
  SphericalHarmonics(unit.degrees(), grid).synthesis(unit, shape);
  shape.rowwise() -= moments.centroid.transpose().array();
  shape = placed(shape, placement.effective_radius / radius_of_sphere(moments.volume), placement);
  if (!shape.isFinite().all())
    throw std::domain_error("surface coefficients: the enclosed volume is too small for the size of the surface");
  return shape;
}

}  // namespace vesiflow::vesicle
