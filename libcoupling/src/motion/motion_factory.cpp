// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The one place where motions meet all parameters.
#include "motion/motion_factory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/flow.h"
#include "motion/following_parameters.h"
#include "motion/implicit_motion.h"
#include "motion/material_motion.h"
#include "motion/mirror_symmetry.h"
#include "motion/shape_following.h"
#include "vesicle/mesh_control.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {
namespace {

SurroundingFluid fluid_around(const SimulationParameters& all, std::size_t vesicle) {
  SurroundingFluid fluid;
  fluid.has_inertia = all.fluid.inertia != fluid::Inertia::none;
  fluid.reynolds_number = all.fluid.reynolds_number;
  fluid.extrapolates_viscosity = all.fluid.viscous_treatment == fluid::ViscousTreatment::extrapolated;
  SurroundingFluid::Viscosities viscosities;
  viscosities.own_ratio = all.viscosity_ratio(vesicle);
  viscosities.largest = all.viscosity_range().greatest;
  viscosities.is_explicit_in_part = all.has_viscosity_field() && fluid.has_inertia &&
                                    all.fluid.viscous_treatment != fluid::ViscousTreatment::implicit;
  fluid.set_viscosities(viscosities);
  return fluid;
}

FollowedShape::Parameters shape_parameters(const SimulationParameters& all, const Flow& flow, std::size_t number,
                                           const vesicle::Membrane& membrane) {
  FollowedShape::Parameters shape;
  shape.radius = std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi));
  const int chosen =
      all.mesh.normal_degrees > 0 ? all.mesh.normal_degrees : vesicle::two_thirds_degrees(all.latitudes(number));
  shape.degrees = all.coupling.method == CouplingMethod::sharp
                      ? std::min(chosen, sharp_degrees(shape.radius, all.spacing()))
                      : resolved_degrees(chosen, shape.radius, all.spacing());
  shape.has_tension = membrane.parameters().sigma0 > 0.0;
  shape.ties_strain = shape.has_tension && all.membrane.volume != vesicle::VolumeControl::none;

  ShapeConservation::Parameters& kept = shape.conservation;
  kept.keeps_volume = all.membrane.volume == vesicle::VolumeControl::projection;
  kept.keeps_area = shape.has_tension || all.membrane.area == vesicle::AreaControl::projection;
  kept.has_tension = shape.has_tension;
  kept.radius = shape.radius;
  const double v = vesicle::reduced_volume(membrane.initial_area(), membrane.initial_volume());
  kept.excess_area = std::max(0.0, 1.0 / std::cbrt(v * v) - 1.0);
  kept.strain_rate = flow.greatest_gradient;
  return shape;
}

FollowingParameters following_parameters(const SimulationParameters& all, const Flow& flow, std::size_t vesicle,
                                         const vesicle::Membrane& membrane) {
  FollowingParameters parameters;
  parameters.shape = shape_parameters(all, flow, vesicle, membrane);
  parameters.material = {.sigma0 = membrane.parameters().sigma0,
                         .bending = 0.25 / membrane.parameters().capillary_number};
  parameters.fluid = fluid_around(all, vesicle);
  parameters.grid.degrees = grid_degrees(parameters.shape.radius, all.spacing());
  parameters.grid.spacing = all.finest_spacing();
  parameters.grid.is_corrected = all.coupling.thickness_correction;
  // A correction of the thickness makes the answer that of a thin membrane.
  parameters.grid.is_sharp = all.coupling.method == CouplingMethod::sharp;
  if (!parameters.grid.is_corrected && !parameters.grid.is_sharp)
    parameters.grid.thickness = MembraneResponse::second_moments(all.coupling.kernel);
  parameters.corrects_fluid = parameters.grid.is_sharp && parameters.fluid.has_inertia;
  parameters.unit_of_length = all.vesicles[vesicle].radius;
  return parameters;
}

std::unique_ptr<MembraneMotion> make_material_motion(const SimulationParameters& all, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane) {
  const MaterialMotion::Parameters parameters{
      .interpolates_in_time = all.time.fluid_velocity == FluidVelocity::interpolated,
      .has_stages = all.time.markers == MarkerMotion::arkode,
      .estimates_error = all.time.adaptive};
  auto integrator =
      make_marker_integrator(all.time.markers, static_cast<std::size_t>(membrane.positions().size()),
                             {all.time.relative_tolerance, all.time.absolute_tolerance * all.vesicles[vesicle].radius});
  return std::make_unique<MaterialMotion>(parameters, std::move(integrator), MirrorSymmetry(all, membrane.positions()),
                                          membrane);
}

}  // namespace

std::unique_ptr<MembraneMotion> make_membrane_motion(const SimulationParameters& all, const Flow& flow,
                                                     std::size_t vesicle, const vesicle::Membrane& membrane) {
  const bool is_implicit = all.time.markers == MarkerMotion::implicit;
  if (!is_implicit && all.time.markers != MarkerMotion::shape_following)
    return make_material_motion(all, vesicle, membrane);
  const FollowingParameters parameters = following_parameters(all, flow, vesicle, membrane);
  const MirrorSymmetry symmetry(all, membrane.positions());
  if (is_implicit) return std::make_unique<ImplicitMotion>(parameters, symmetry, membrane);
  return std::make_unique<ShapeFollowing>(parameters, symmetry, membrane);
}

}  // namespace vesiflow::coupling
