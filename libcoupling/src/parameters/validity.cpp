// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/validity.h"

#include <algorithm>
#include <limits>

#include "coupling/flow.h"
#include "fluid/convection_stability.h"

namespace vesiflow::coupling {

double stable_bending_step(const SimulationParameters& parameters) {
  double stiffest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i)
    stiffest = std::min(stiffest, own_capillary_number(parameters, i));
  const bool is_sharp = parameters.coupling.method == CouplingMethod::sharp;
  return (is_sharp ? validity::bending_step_of_sharp : validity::bending_step) * stiffest;
}

double quiet_tension_number(const SimulationParameters& parameters) {
  const double re = vesicle_reynolds_number(parameters);
  if (parameters.time.markers != MarkerMotion::shape_following || re < validity::least_inertia)
    return std::numeric_limits<double>::infinity();
  return re <= 1.0 ? validity::quiet_g_to_one : validity::quiet_g_above_one;
}

double stable_convection_step(const SimulationParameters& parameters, const Flow& flow) {
  double least = std::numeric_limits<double>::infinity();
  if (parameters.fluid.inertia != fluid::Inertia::full || !flow.greatest_speed) return least;
  const SimulationParameters::Domain& domain = parameters.domain;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double h = (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis];
    least = std::min(least, fluid::stable_convection_step(*flow.greatest_speed, h, parameters.fluid.reynolds_number,
                                                          parameters.viscosity_range().greatest,
                                                          parameters.fluid.viscous_treatment));
  }
  return least;
}

double largest_radius(const SimulationParameters& parameters) {
  double radius = 0.0;
  for (const VesicleParameters& vesicle : parameters.vesicles) radius = std::max(radius, vesicle.radius);
  return radius;
}

double vesicle_reynolds_number(const SimulationParameters& parameters) {
  const double radius = largest_radius(parameters);
  return parameters.fluid.inertia == fluid::Inertia::none ? 0.0 : parameters.fluid.reynolds_number * radius * radius;
}

bool passes_inertia_of_thin_sharp(const SimulationParameters& parameters) {
  const double ratio = parameters.viscosity_range().least;
  return ratio < validity::thin_sharp_ratio &&
         vesicle_reynolds_number(parameters) > validity::largest_reynolds_number_of_thin_sharp(ratio);
}

bool passes_inertia_of_fine_sharp(const SimulationParameters& parameters) {
  constexpr double rounding = 1.125;  // up to an even number of cells with small factors
  return vesicle_reynolds_number(parameters) > validity::largest_reynolds_number_of_fine_sharp &&
         largest_radius(parameters) >
             rounding * validity::most_cells_per_radius_with_inertia_of_sharp * parameters.spacing();
}

double own_capillary_number(const SimulationParameters& parameters, std::size_t vesicle) {
  const double radius = parameters.vesicles[vesicle].radius;
  return parameters.capillary_number(vesicle) * radius * radius * radius;
}

}  // namespace vesiflow::coupling
