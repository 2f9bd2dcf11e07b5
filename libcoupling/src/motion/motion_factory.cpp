// The one place where motions meet scenes.
#include "motion/motion_factory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/flow.h"
#include "mirror_symmetry.h"
#include "motion/following_parameters.h"
#include "motion/implicit_motion.h"
#include "motion/material_motion.h"
#include "motion/shape_following.h"
#include "vesicle/mesh_control.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {
namespace {

SurroundingFluid fluid_around(const Scene& scene, std::size_t vesicle) {
  SurroundingFluid fluid;
  fluid.has_inertia = scene.fluid.inertia != fluid::Inertia::none;
  fluid.reynolds_number = scene.fluid.reynolds_number;
  fluid.extrapolates_viscosity = scene.fluid.viscous_treatment == fluid::ViscousTreatment::extrapolated;
  SurroundingFluid::Viscosities viscosities;
  viscosities.own_ratio = scene.viscosity_ratio(vesicle);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    viscosities.largest = std::max(viscosities.largest, scene.viscosity_ratio(i));
  viscosities.is_explicit_in_part = scene.has_viscosity_contrast() && fluid.has_inertia &&
                                    scene.fluid.viscous_treatment != fluid::ViscousTreatment::implicit;
  fluid.set_viscosities(viscosities);
  return fluid;
}

FollowedShape::Parameters shape_parameters(const Scene& scene, std::size_t number, const vesicle::Membrane& membrane) {
  FollowedShape::Parameters shape;
  shape.radius = std::sqrt(membrane.initial_area() / (4.0 * std::numbers::pi));
  const int chosen =
      scene.mesh.normal_degrees > 0 ? scene.mesh.normal_degrees : vesicle::two_thirds_degrees(scene.latitudes(number));
  shape.degrees = resolved_degrees(chosen, shape.radius, scene.spacing());
  shape.has_tension = membrane.parameters().sigma0 > 0.0;
  shape.ties_strain = shape.has_tension && scene.membrane.volume != vesicle::VolumeControl::none;

  ShapeConservation::Parameters& kept = shape.conservation;
  kept.keeps_volume = scene.membrane.volume == vesicle::VolumeControl::projection;
  kept.keeps_area = shape.has_tension || scene.membrane.area == vesicle::AreaControl::projection;
  kept.has_tension = shape.has_tension;
  kept.radius = shape.radius;
  const double v = vesicle::reduced_volume(membrane.initial_area(), membrane.initial_volume());
  kept.excess_area = std::max(0.0, 1.0 / std::cbrt(v * v) - 1.0);
  if (scene.flow.type != FlowType::custom) kept.strain_rate = flow_of(scene).greatest_gradient;
  return shape;
}

FollowingParameters following_parameters(const Scene& scene, std::size_t vesicle, const vesicle::Membrane& membrane) {
  FollowingParameters parameters;
  parameters.shape = shape_parameters(scene, vesicle, membrane);
  parameters.material = {.sigma0 = membrane.parameters().sigma0,
                         .bending = 0.25 / membrane.parameters().capillary_number};
  parameters.fluid = fluid_around(scene, vesicle);
  parameters.grid.degrees = grid_degrees(parameters.shape.radius, scene.spacing());
  parameters.grid.spacing = scene.finest_spacing();
  parameters.grid.is_corrected = scene.coupling.thickness_correction;
  // A correction of the thickness makes the answer that of a thin membrane.
  if (!parameters.grid.is_corrected)
    parameters.grid.thickness = MembraneResponse::second_moments(scene.coupling.kernel);
  parameters.unit_of_length = scene.vesicles[vesicle].radius;
  return parameters;
}

std::unique_ptr<MembraneMotion> make_material_motion(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane) {
  const MaterialMotion::Parameters parameters{
      .interpolates_in_time = scene.time.fluid_velocity == FluidVelocity::interpolated,
      .has_stages = scene.time.markers == "arkode",
      .estimates_error = scene.time.adaptive};
  auto integrator = make_marker_integrator(
      scene.time.markers, static_cast<std::size_t>(membrane.positions().size()),
      {scene.time.relative_tolerance, scene.time.absolute_tolerance * scene.vesicles[vesicle].radius});
  return std::make_unique<MaterialMotion>(parameters, std::move(integrator),
                                          MirrorSymmetry(scene, membrane.positions()), membrane);
}

}  // namespace

std::unique_ptr<MembraneMotion> make_membrane_motion(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane) {
  const bool is_implicit = scene.time.markers == "implicit";
  if (!is_implicit && scene.time.markers != "shape_following") return make_material_motion(scene, vesicle, membrane);
  const FollowingParameters parameters = following_parameters(scene, vesicle, membrane);
  const MirrorSymmetry symmetry(scene, membrane.positions());
  if (is_implicit) return std::make_unique<ImplicitMotion>(parameters, symmetry, membrane);
  return std::make_unique<ShapeFollowing>(parameters, symmetry, membrane);
}

}  // namespace vesiflow::coupling
