// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "known_surfaces.h"

#include <cmath>
#include <numbers>

using vesiflow::vesicle::SphereGrid;
using vesiflow::vesicle::VectorField;

namespace {

using std::exp;

constexpr long double long_pi = std::numbers::pi_v<long double>;

// Not the grid's longitude(), which is rounded: the markers should be no worse than the numbers that hold them.
long double longitude(const SphereGrid& grid, int i) {
  return 2 * long_pi * i / grid.longitudes();
}

auto ellipsoid(long double a, long double b, long double c) {
  return [a, b, c](const auto& s) { return std::decay_t<decltype(s)>{a * s[0], b * s[1], c * s[2]}; };
}

/// Of volume 4 pi / 3.
auto spheroid(long double equatorial, long double polar) {
  const long double r = std::cbrt(equatorial * equatorial * polar);
  return ellipsoid(equatorial / r, equatorial / r, polar / r);
}

/// Radius 1 + exp(-3 Re Y_3^2).
auto y32() {
  const long double norm = std::sqrt(105 / (2 * long_pi)) / 4;
  return [norm](const auto& s) {
    using Number = std::decay_t<decltype(s[0])>;
    const Number y = norm * ((s[0] * s[0] - s[1] * s[1]) * s[2]);
    const Number r = Number(1) + exp(-3.0L * y);
    return Point<Number>{r * s[0], r * s[1], r * s[2]};
  };
}

/// The red cell of Evans and Fung (1972), in units of its radius.
auto biconcave() {
  return [](const auto& s) {
    using Number = std::decay_t<decltype(s[0])>;
    const Number q = s[0] * s[0] + s[1] * s[1];
    const Number half_thickness = Number(0.207161L) + 2.002558L * q - 1.122762L * (q * q);
    return Point<Number>{s[0], s[1], 0.5L * (s[2] * half_thickness)};
  };
}

}  // namespace

VectorField KnownSurface::sample(const SphereGrid& grid) const {
  VectorField positions(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const long double s = grid.sin_colatitude()[j], c = grid.cos_colatitude()[j], phi = longitude(grid, i);
      const Point<long double> x = position_({s * std::cos(phi), s * std::sin(phi), c});
      for (int k = 0; k < 3; ++k) positions(grid.index(i, j), k) = static_cast<double>(x[k]);
    }
  return positions;
}

Reference KnownSurface::reference(const SphereGrid& nodes) const {
  Reference result;
  for (auto* field : {&result.values.mean, &result.values.gaussian, &result.values.laplacian})
    field->resize(nodes.size());
  for (int j = 0; j < nodes.latitudes(); ++j)
    for (int i = 0; i < nodes.longitudes(); ++i) {
      const PointGeometry point =
          exact_geometry(patch_, nodes.sin_colatitude()[j], nodes.cos_colatitude()[j], longitude(nodes, i));
      const Eigen::Index k = nodes.index(i, j);
      result.values.mean[k] = static_cast<double>(point.mean_curvature);
      result.values.gaussian[k] = static_cast<double>(point.gaussian_curvature);
      result.values.laplacian[k] = static_cast<double>(point.curvature_laplacian);
    }
  return result;
}

PointGeometry KnownSurface::at(long double theta, long double phi) const {
  return exact_geometry(patch_, std::sin(theta), std::cos(theta), phi);
}

const std::vector<std::string>& known_surface_names() {
  static const std::vector<std::string> names = {"sphere", "ellipsoid", "y32", "prolate", "oblate", "biconcave"};
  return names;
}

std::unique_ptr<KnownSurface> make_known_surface(const std::string& name) {
  const auto make = [&name](const char* description, const auto& formula) {
    return std::make_unique<KnownSurface>(name, description, formula);
  };
  if (name == "sphere") return make("the unit sphere", ellipsoid(1, 1, 1));
  if (name == "ellipsoid") return make("the ellipsoid with semi-axes 1, 2, 4", ellipsoid(1, 2, 4));
  if (name == "y32") return make("r = 1 + exp(-3 Re Y_3^2)", y32());
  if (name == "prolate") return make("the spheroid 1 : 1 : 2.8 of volume 4 pi / 3", spheroid(1, 2.8L));
  if (name == "oblate") return make("the spheroid 3 : 3 : 1 of volume 4 pi / 3", spheroid(3, 1));
  if (name == "biconcave") return make("the red cell of Evans and Fung, radius 1", biconcave());
  return nullptr;
}
