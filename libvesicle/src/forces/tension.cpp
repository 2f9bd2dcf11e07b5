// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/tension.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

void check_target_areas(const ScalarField& target_areas, const Surface& surface) {
  check_markers(target_areas, "target_areas", surface.grid().size());
  check_areas(target_areas, "a target area");
}

}  // namespace

TensionForce::TensionForce(const TensionParameters& parameters) : parameters_(parameters) {
  check_argument(std::isfinite(parameters.sigma0) && parameters.sigma0 >= 0, "sigma0", parameters.sigma0,
                 "finite and >= 0");
}

void TensionForce::evaluate(const Surface& surface, const ScalarField& target_areas, ScalarField& tension) const {
  check_target_areas(target_areas, surface);
  const ScalarField& areas = surface.area_weight();
  if (parameters_.law == TensionLaw::logarithmic)
    tension = parameters_.sigma0 * (target_areas / areas) * (areas / target_areas).log();
  else
    tension = parameters_.sigma0 * (areas / target_areas - 1);
}

void TensionForce::evaluate(const ScalarField& strain, ScalarField& tension) const {
  if (parameters_.law == TensionLaw::logarithmic)
    tension = parameters_.sigma0 * strain * (-strain).exp();
  else
    tension = parameters_.sigma0 * (strain.exp() - 1);
}

void TensionForce::add_to(const Surface& surface, const ScalarField& tension, VectorField& force) {
  check_markers(tension, "tension", surface.grid().size());
  check_markers(force, "force", surface.grid().size());
  check_finite(tension, "a tension");
  if (parameters_.form == TensionForm::divergence) {
    surface.projector_divergence(tension, force_);
  } else {
    surface.gradient(tension, force_);
    for (int component = 0; component < 3; ++component)
      force_.col(component) -= 2 * tension * surface.mean_curvature() * surface.normal().col(component);
  }
  force += force_;
}

double TensionForce::energy(const Surface& surface, const ScalarField& target_areas) const {
  check_target_areas(target_areas, surface);
  const ScalarField& areas = surface.area_weight();
  const double sum = parameters_.law == TensionLaw::logarithmic
                         ? ((areas / target_areas).log().square() * target_areas).sum()
                         : ((areas / target_areas - 1).square() * target_areas).sum();
  return 0.5 * parameters_.sigma0 * sum;
}

}  // namespace vesiflow::vesicle
