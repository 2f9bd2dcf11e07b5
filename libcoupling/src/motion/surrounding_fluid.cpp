// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/surrounding_fluid.h"

#include "motion/constants.h"

namespace vesiflow::coupling {

void SurroundingFluid::set_viscosities(const Viscosities& viscosities) {
  solved_viscosity = 0.5 * (1.0 + viscosities.own_ratio);
  explicit_viscosity = 0.0;
  is_thin_inside = viscosities.own_ratio < 1.0;
  if (!viscosities.is_explicit_in_part) return;
  explicit_viscosity = viscosities.largest - solved_viscosity;
  solved_viscosity = viscosities.largest;
}

double SurroundingFluid::lagging_overestimate() const {
  const double share = explicit_viscosity / solved_viscosity;
  double lagging = constants::overestimate_per_ratio * share * (solved_viscosity - 1.0);
  if (extrapolates_viscosity && is_thin_inside) lagging += constants::overestimate_of_thin_fluid * share;
  return lagging;
}

double SurroundingFluid::remembered_viscosity() const {
  return explicit_viscosity * (is_thin_inside ? constants::memory_of_thin_fluid : constants::viscous_memory);
}

}  // namespace vesiflow::coupling
