// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/sphere_grid.h"

#include <cmath>
#include <numbers>

#include "check.h"
#include "harmonics/gauss_legendre.h"

namespace vesiflow::vesicle {

namespace {

int checked_latitudes(int latitudes) {
  check_argument(latitudes >= 2 && latitudes <= SphereGrid::largest_latitudes, "latitudes", latitudes, "in [2, 4096]");
  return latitudes;
}

}  // namespace

SphereGrid::SphereGrid(int latitudes) : SphereGrid(latitudes, 2 * checked_latitudes(latitudes)) {}

SphereGrid::SphereGrid(int latitudes, int longitudes)
    : latitudes_(checked_latitudes(latitudes)), longitudes_(longitudes) {
  check_argument(longitudes >= 2 * latitudes && longitudes <= largest_longitudes && longitudes % 2 == 0, "longitudes",
                 longitudes, "even, at least twice the latitudes and at most 16384");
  const GaussLegendre rule = gauss_legendre(latitudes);
  for (ScalarField* field : {&colatitude_, &sin_, &cos_, &weight_, &parameter_measure_}) field->resize(latitudes);
  const long double spacing = 2 * std::numbers::pi_v<long double> / longitudes;
  for (int j = 0; j < latitudes; ++j) {
    // Functions of the unrounded node: the far half of (0, pi) would otherwise lose relative accuracy in the
    // sine.
    const bool north = 2 * j < latitudes;
    const long double from_pole = rule.colatitude[north ? j : latitudes - 1 - j];
    colatitude_[j] = static_cast<double>(rule.colatitude[j]);
    sin_[j] = static_cast<double>(std::sin(from_pole));
    cos_[j] = static_cast<double>(north ? std::cos(from_pole) : -std::cos(from_pole));
    weight_[j] = static_cast<double>(rule.weight[j]);
    parameter_measure_[j] = static_cast<double>(rule.weight[j] * spacing / std::sin(from_pole));
  }
}

double SphereGrid::longitude_spacing() const {
  return 2 * std::numbers::pi / longitudes_;
}

}  // namespace vesiflow::vesicle
