// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/integral_tension.h"

#include <algorithm>
#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

int checked_degrees(const SphereGrid& grid, const IntegralTensionParameters& parameters) {
  check_argument(std::isfinite(parameters.rate) && parameters.rate >= 0, "integral_rate", parameters.rate,
                 "finite and >= 0");
  check_argument(parameters.degrees >= 1, "integral_degrees", parameters.degrees, ">= 1");
  return std::min(parameters.degrees, grid.latitudes());
}

}  // namespace

IntegralTension::IntegralTension(const SphereGrid& grid, const IntegralTensionParameters& parameters)
    : rate_(parameters.rate),
      harmonics_(checked_degrees(grid, parameters), grid, 1),
      coefficients_(harmonics_.degrees(), 1),
      smooth_strain_(grid.size()) {}

void IntegralTension::advance(const ScalarField& strain, double dt, ScalarField& multiplier) {
  check_markers(strain, "strain", smooth_strain_.rows());
  check_markers(multiplier, "multiplier", smooth_strain_.rows());
  check_finite(strain, "a strain");
  harmonics_.analysis(strain, coefficients_);
  harmonics_.synthesis(coefficients_, smooth_strain_);
  multiplier += dt * rate_ * smooth_strain_;
}

double IntegralTension::energy(const Surface& surface, const ScalarField& target_areas, const ScalarField& multiplier) {
  check_markers(target_areas, "target_areas", surface.grid().size());
  check_markers(multiplier, "multiplier", surface.grid().size());
  return (multiplier * (surface.area_weight() - target_areas)).sum();
}

}  // namespace vesiflow::vesicle
