// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/bending.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

const BendingParameters& checked(const BendingParameters& p) {
  check_argument(p.capillary_number > 0, "capillary_number", p.capillary_number, "> 0");
  check_argument(std::isfinite(p.spontaneous_curvature), "spontaneous_curvature", p.spontaneous_curvature, "finite");
  return p;
}

}  // namespace

double bending_energy(const Surface& surface, double spontaneous_curvature) {
  check_argument(std::isfinite(spontaneous_curvature), "spontaneous_curvature", spontaneous_curvature, "finite");
  return 0.5 * ((surface.mean_curvature() - spontaneous_curvature).square() * surface.area_weight()).sum();
}

BendingForce::BendingForce(const SphereGrid& grid, const BendingParameters& parameters)
    : parameters_(checked(parameters)), laplacian_(grid, parameters.laplacian), normal_force_(grid.size()) {}

void BendingForce::add_to(const Surface& surface, VectorField& force) {
  check_markers(force, "force", surface.grid().size());
  laplacian_.of_mean_curvature(surface, normal_force_);
  const double h0 = parameters_.spontaneous_curvature;
  const ScalarField& h = surface.mean_curvature();
  const ScalarField& k = surface.gaussian_curvature();
  normal_force_ = (0.5 * normal_force_ + (h - h0) * (h.square() - k + h0 * h)) / parameters_.capillary_number;
  for (int component = 0; component < 3; ++component)
    force.col(component) += normal_force_ * surface.normal().col(component);
}

double BendingForce::energy(const Surface& surface) const {
  return bending_energy(surface, parameters_.spontaneous_curvature) / parameters_.capillary_number;
}

}  // namespace vesiflow::vesicle
