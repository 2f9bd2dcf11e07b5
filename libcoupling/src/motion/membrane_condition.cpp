// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/membrane_condition.h"

#include <algorithm>
#include <cmath>

namespace vesiflow::coupling {

MembraneCondition MembraneCondition::of(const vesicle::Membrane& membrane, double radius) {
  const vesicle::Surface& surface = membrane.surface();
  MembraneCondition condition;
  condition.largest_tension = std::max(0.0, membrane.tension().maxCoeff());
  condition.compression = greatest_compression(surface, radius);
  if (membrane.parameters().sigma0 > 0.0) {
    const auto& h = surface.mean_curvature();
    const double mean = (h * surface.area_weight()).sum() / surface.area();
    condition.curvature_variance = 4.0 * ((h - mean).square() * surface.area_weight()).sum() / surface.area();
  }
  return condition;
}

double greatest_compression(const vesicle::Surface& surface, double radius) {
  const vesicle::SphereGrid& grid = surface.grid();
  double largest = 0.0;
  for (int j = 0; j < grid.latitudes(); ++j) {
    const double sine = grid.sin_colatitude()[j];
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index m = grid.index(i, j);
      largest = std::max({largest, surface.geometry().dual_theta().row(m).square().sum(),
                          surface.geometry().dual_phi().row(m).square().sum() * sine * sine});
    }
  }
  return std::max(1.0, radius * std::sqrt(largest));
}

}  // namespace vesiflow::coupling
