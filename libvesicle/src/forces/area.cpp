// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/area.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
void add_area_penalty(const Surface& surface, double stiffness, double target_area, VectorField& force) {
  check_penalty(stiffness, "target_area", target_area);
  check_markers(force, "force", surface.grid().size());
  const double tension = stiffness * (surface.area() - target_area) / target_area;
  for (int component = 0; component < 3; ++component)
    force.col(component) -= 2 * tension * surface.mean_curvature() * surface.normal().col(component);
}

double area_penalty_energy(const Surface& surface, double stiffness, double target_area) {
  check_penalty(stiffness, "target_area", target_area);
  const double excess = surface.area() - target_area;
  return 0.5 * stiffness * excess * excess / target_area;
}

double area_rate(const Surface& surface, const VectorField& velocity) {
  check_markers(velocity, "velocity", surface.grid().size());
  check_finite(velocity, "a velocity");
  return 2 * ((velocity * surface.normal()).rowwise().sum() * surface.mean_curvature() * surface.area_weight()).sum();
}

}  // namespace vesiflow::vesicle
