#include "immersed_vesicle.h"

#include "initial_shape.h"
#include "phase_timer.h"

namespace vesiflow::coupling {
namespace {

vesicle::MembraneParameters membrane_parameters(const Scene& scene, std::size_t i) {
  vesicle::MembraneParameters parameters;
  parameters.capillary_number = scene.capillary_number(i);
  parameters.sigma0 = scene.sigma0(i);
  parameters.spontaneous_curvature = scene.spontaneous_curvature(i);
  parameters.tension_law = scene.membrane.tension_law;
  parameters.tension_form = scene.membrane.tension_form;
  parameters.area = scene.membrane.area;
  parameters.area_stiffness = scene.membrane.area_stiffness;
  parameters.laplacian.form = scene.membrane.laplacian;
  parameters.laplacian.upsampling = scene.membrane.upsampling;
  // Eq. (14) goes with the truncation that the paper gives it.
  parameters.laplacian.truncated = scene.membrane.laplacian == vesicle::LaplacianForm::paper;
  parameters.volume = scene.membrane.volume;
  parameters.volume_stiffness = scene.membrane.volume_stiffness;
  parameters.filter = scene.mesh.filter;
  parameters.slip = scene.mesh.slip;
  parameters.normal_degrees = scene.mesh.normal_degrees;
  parameters.tangential_degrees = scene.mesh.tangential_degrees;
  return parameters;
}

}  // namespace

int moving_degrees(const Scene& scene, std::size_t i) {
  const int degrees = scene.mesh.normal_degrees;
  return degrees > 0 ? degrees : vesicle::two_thirds_degrees(scene.latitudes(i));
}

ImmersedVesicle::ImmersedVesicle(const Scene& scene, std::size_t number, const fluid::Grid& grid)
    : membrane(initial_markers(scene.vesicles[number], scene.latitudes(number)), scene.latitudes(number),
               membrane_parameters(scene, number)),
      transfer(grid, scene.coupling.kernel, mirrors_crossed(grid, membrane.positions())),
      motion(make_membrane_motion(scene, number, membrane)) {
  if (scene.coupling.thickness_correction)
    thickness_.emplace(membrane, scene.coupling.kernel, scene.spacing(), 0.5 * (1.0 + scene.viscosity_ratio(number)));
  const Eigen::Index markers = membrane.positions().rows();
  velocities = {vesicle::VectorField::Zero(markers, 3), vesicle::VectorField::Zero(markers, 3)};
  velocity_at_ = [this](const Eigen::Ref<const vesicle::VectorField>& positions, vesicle::VectorField& velocity) {
    const PhaseTimer timer(*interpolation_seconds_);
    transfer.update(positions);
    transfer.interpolate(*fluid_velocity_, velocity);
    if (thickness_) thickness_->add_to(membrane, velocity);
  };
}

void ImmersedVesicle::update() {
  if (is_current) return;
  membrane.update_geometry();
  membrane.compute_force();
  is_current = true;
}

void ImmersedVesicle::predict(double dt) {
  if (motion->predict(dt, membrane)) is_current = false;
  update();
}

void ImmersedVesicle::advance(double dt, const fluid::FaceVector& velocity, double& interpolation_seconds) {
  fluid_velocity_ = &velocity;
  interpolation_seconds_ = &interpolation_seconds;
  motion->advance(dt, velocity_at_, membrane, velocities);
  is_current = false;
}

void ImmersedVesicle::interpolate(double dt, const fluid::FaceVector& velocity) {
  transfer.update(membrane.positions());
  transfer.interpolate(velocity, velocities.fluid);
  if (thickness_) {
    update();
    thickness_->add_to(membrane, velocities.fluid);
  }
  motion->mesh_velocity(dt, membrane, velocities);
}

}  // namespace vesiflow::coupling
