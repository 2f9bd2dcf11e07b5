#include "immersed_vesicle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "initial_shape.h"
#include "motion/motion_factory.h"
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
  if (scene.time.markers == "strain_relaxation") parameters.strain_relaxation = scene.time.relaxation;
  parameters.integral_tension = {scene.membrane.integral_rate, scene.membrane.integral_degrees};
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

vesicle::Membrane make_membrane(const Scene& scene, std::size_t i, const vesicle::MembraneState* start) {
  const int latitudes = scene.latitudes(i);
  vesicle::Membrane membrane(start != nullptr ? start->positions : initial_markers(scene.vesicles[i], latitudes),
                             latitudes, membrane_parameters(scene, i));
  if (start != nullptr) {
    membrane.restore(*start);
    membrane.keep_target_area();
  }
  return membrane;
}

}  // namespace

int moving_degrees(const Scene& scene, std::size_t i) {
  const int degrees = scene.mesh.normal_degrees;
  return degrees > 0 ? degrees : vesicle::two_thirds_degrees(scene.latitudes(i));
}

ImmersedVesicle::ImmersedVesicle(const Scene& scene, std::size_t number, const fluid::Grid& grid,
                                 const vesicle::MembraneState* start)
    : membrane(make_membrane(scene, number, start)),
      transfer(grid, scene.coupling.kernel, mirrors_crossed(grid, membrane.positions())),
      motion(make_membrane_motion(scene, number, membrane)) {
  if (scene.coupling.thickness_correction)
    thickness_.emplace(membrane, scene.coupling.kernel, scene.spacing(), 0.5 * (1.0 + scene.viscosity_ratio(number)));
  const Eigen::Index markers = membrane.positions().rows();
  velocities = {vesicle::VectorField::Zero(markers, 3), vesicle::VectorField::Zero(markers, 3)};
}

void ImmersedVesicle::FlowAtMarkers::operator()(const Positions& positions, vesicle::VectorField& velocity) const {
  (*this)(1.0, positions, velocity);
}

void ImmersedVesicle::FlowAtMarkers::operator()(double fraction, const Positions& positions,
                                                vesicle::VectorField& velocity) const {
  {
    const PhaseTimer timer(vesicle_.moving.interpolate);
    vesicle_.transfer.update(positions);
    vesicle_.transfer.interpolate(*vesicle_.velocity_, velocity);
    if (fraction != 1.0) {
      vesicle::VectorField& at_start = vesicle_.at_start_;
      at_start.resize(velocity.rows(), 3);
      vesicle_.transfer.interpolate(*vesicle_.previous_velocity_, at_start);
      velocity = fraction * velocity + (1.0 - fraction) * at_start;
    }
  }
  if (!vesicle_.thickness_) return;
  const PhaseTimer timer(vesicle_.moving.thickness_correction);
  vesicle_.thickness_->add_to(vesicle_.membrane, vesicle_.force(), velocity);
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

void ImmersedVesicle::advance(double dt, const fluid::FaceVector& previous_velocity,
                              const fluid::FaceVector& velocity) {
  moving = {};
  const PhaseTimer timer(moving.mesh);
  previous_velocity_ = &previous_velocity;
  velocity_ = &velocity;
  motion->advance(dt, FlowAtMarkers(*this), membrane, velocities);
  is_current = false;
}

void ImmersedVesicle::restore_history(double dt, std::span<const double> history) {
  if (!std::ranges::all_of(history, [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("the history of the markers has a value that is not finite");
  if (history.empty())
    motion->restart();
  else
    motion->restore_history(dt, history);
}

void ImmersedVesicle::interpolate(double dt, const fluid::FaceVector& velocity) {
  transfer.update(membrane.positions());
  transfer.interpolate(velocity, velocities.fluid);
  if (thickness_) {
    update();
    thickness_->add_to(membrane, force(), velocities.fluid);
  }
  motion->mesh_velocity(dt, membrane, velocities);
}

}  // namespace vesiflow::coupling
