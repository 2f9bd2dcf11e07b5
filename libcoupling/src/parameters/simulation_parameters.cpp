// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/simulation_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/validity.h"

namespace vesiflow::coupling {
namespace {

std::array<double, 3> spacings(const SimulationParameters::Domain& domain) {
  std::array<double, 3> all{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    all[axis] = (domain.upper[axis] - domain.lower[axis]) / domain.cells[axis];
  return all;
}

}  // namespace

double SimulationParameters::spacing() const {
  const std::array<double, 3> all = spacings(domain);
  return *std::ranges::max_element(all);
}

double SimulationParameters::finest_spacing() const {
  const std::array<double, 3> all = spacings(domain);
  return *std::ranges::min_element(all);
}

double SimulationParameters::tension_number() const {
  double stiffest = vesicles.empty() ? membrane.sigma0 : 0.0;
  for (std::size_t i = 0; i < vesicles.size(); ++i) stiffest = std::max(stiffest, sigma0(i));
  return time.step * stiffest / (4.0 * finest_spacing());
}

double SimulationParameters::capillary_number(std::size_t i) const {
  return vesicles.at(i).capillary_number.value_or(membrane.capillary_number);
}

double SimulationParameters::sigma0(std::size_t i) const {
  return vesicles.at(i).sigma0.value_or(membrane.sigma0);
}

double SimulationParameters::spontaneous_curvature(std::size_t i) const {
  return vesicles.at(i).spontaneous_curvature.value_or(membrane.spontaneous_curvature);
}

int SimulationParameters::latitudes(std::size_t i) const {
  return vesicles.at(i).latitudes.value_or(mesh.latitudes);
}

double SimulationParameters::viscosity_ratio(std::size_t i) const {
  return vesicles.at(i).viscosity_ratio.value_or(fluid.viscosity_ratio);
}

SimulationParameters::ViscosityRange SimulationParameters::viscosity_range() const {
  ViscosityRange range;
  for (std::size_t i = 0; i < vesicles.size(); ++i) {
    range.least = std::min(range.least, viscosity_ratio(i));
    range.greatest = std::max(range.greatest, viscosity_ratio(i));
  }
  return range;
}

bool SimulationParameters::has_viscosity_contrast() const {
  const ViscosityRange range = viscosity_range();
  return range.least != 1.0 || range.greatest != 1.0;
}

bool SimulationParameters::has_viscosity_field() const {
  return has_viscosity_contrast() && coupling.method == CouplingMethod::delta;
}

bool SimulationParameters::has_scaled_velocity() const {
  return has_viscosity_contrast() && coupling.method == CouplingMethod::sharp;
}

bool SimulationParameters::has_phase_inertia() const {
  return has_scaled_velocity() && fluid.inertia != fluid::Inertia::none;
}

PhaseSplitting SimulationParameters::phase_splitting() const {
  const auto [least, greatest] = viscosity_range();
  return coupling::phase_splitting(fluid.reynolds_number, least, greatest,
                                   vesicle_reynolds_number(*this) <= validity::slow_reynolds_number_of_phases);
}

bool SimulationParameters::corrects_fluid(double dt) const {
  if (coupling.method != CouplingMethod::sharp || fluid.inertia == fluid::Inertia::none ||
      time.markers != MarkerMotion::shape_following)
    return false;
  // Inside, w = mu u has the Reynolds number Re/ratio.
  return vesicle_reynolds_number(*this) > dt * std::min(1.0, viscosity_range().least);
}

bool SimulationParameters::follows_shape() const {
  return time.markers == MarkerMotion::shape_following || time.markers == MarkerMotion::implicit;
}

double SimulationParameters::stable_tension_number() const {
  if (follows_shape()) return std::numeric_limits<double>::infinity();
  const double of_euler =
      coupling.thickness_correction ? validity::stable_g_with_thickness_correction : validity::stable_g;
  if (time.markers == MarkerMotion::ab2) return validity::ab2_share_of_g * of_euler;
  if (time.markers == MarkerMotion::strain_relaxation) return of_euler * ((2.0 - time.relaxation) / time.relaxation);
  return of_euler;
}

long SimulationParameters::steps() const {
  // A last step that would only make up for round-off in time.end is not taken.
  return static_cast<long>(std::min(1e18, std::ceil(time.end / time.step - 1e-6)));
}

fluid::Grid grid_of(const SimulationParameters& parameters) {
  const SimulationParameters::Domain& domain = parameters.domain;
  return {domain.lower, domain.upper, domain.cells, {domain.periodic, domain.mirror}};
}

fluid::FluidParameters fluid_parameters_of(const SimulationParameters& parameters) {
  fluid::FluidParameters of_fluid;
  of_fluid.reynolds_number = parameters.fluid.reynolds_number;
  of_fluid.viscous_treatment = parameters.fluid.viscous_treatment;
  of_fluid.inertia = parameters.fluid.inertia;
  of_fluid.velocity_solver = fluid::default_options(parameters.fluid.velocity_solver);
  of_fluid.pressure_solver = fluid::default_options(parameters.fluid.pressure_solver);
  of_fluid.precision = parameters.fluid.precision;
  return of_fluid;
}

}  // namespace vesiflow::coupling
