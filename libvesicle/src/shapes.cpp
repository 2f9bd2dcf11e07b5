#include "vesicle/shapes.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/LU>

#include "check.h"

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

/// ln of the aspect ratio with the given reduced volume, between 0 (the sphere) and far_side; the reduced
/// volume falls monotonically from 1 on the way. Bisection: it needs no derivative, which vanishes at the
/// sphere.
double log_aspect_ratio(double reduced_volume, double far_side) {
  check_argument(reduced_volume > 0 && reduced_volume <= 1, "reduced_volume", reduced_volume, "in (0, 1]");
  if (spheroid_reduced_volume(std::exp(far_side)) >= reduced_volume)
    throw std::invalid_argument("reduced_volume = " + std::to_string(reduced_volume) +
                                ": no spheroid with an aspect ratio below e^60 is so flat or so slender");
  double near = 0;
  double far = far_side;
  for (double middle = far / 2; middle != near && middle != far; middle = near + (far - near) / 2)
    (spheroid_reduced_volume(std::exp(middle)) >= reduced_volume ? near : far) = middle;
  return near;
}

constexpr double largest_log_aspect_ratio = 60;

}  // namespace

double reduced_volume(double area, double volume) {
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
    area = 1 + q * q / e * std::atanh(e);
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
  for (double p : proportions) check_argument(p > 0 && std::isfinite(p), "semi-axis proportion", p, "finite and > 0");
  check_placement(placement);
  const Vector3 semi_axes = proportions * (placement.effective_radius / std::cbrt(proportions.prod()));
  VectorField positions(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double phi = grid.longitude(i);
      const Vector3 direction(grid.sin_colatitude()[j] * std::cos(phi), grid.sin_colatitude()[j] * std::sin(phi),
                              grid.cos_colatitude()[j]);
      const Vector3 x = placement.centre + placement.rotation * semi_axes.cwiseProduct(direction);
      positions.row(grid.index(i, j)) = x.transpose().array();
    }
  return positions;
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

}  // namespace vesiflow::vesicle
