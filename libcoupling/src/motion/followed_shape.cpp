// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/followed_shape.h"

namespace vesiflow::coupling {

using vesicle::Surface;
using vesicle::VectorField;

FollowedShape::FollowedShape(const Parameters& parameters, const MirrorSymmetry& symmetry,
                             const vesicle::Membrane& membrane)
    : ties_strain_(parameters.ties_strain),
      symmetry_(symmetry),
      harmonics_(parameters.degrees, membrane.surface().grid(), parameters.has_tension ? 4 : 3),
      state_(membrane.positions().rows(), parameters.has_tension),
      mesh_motion_(harmonics_, parameters.radius),
      strain_motion_(membrane.positions().rows()),
      conservation_(parameters.conservation, membrane),
      mean_strain_(parameters.conservation.excess_area),
      error_(membrane.positions().rows()),
      strain_(vesicle::ScalarField::Zero(membrane.positions().rows())),
      predicted_(state_.now()),
      positions_(VectorField::Zero(membrane.positions().rows(), 3)),
      displacement_(positions_),
      coefficients_(parameters.degrees, 3) {
  rates_.fields = state_.now();
}

void FollowedShape::start(vesicle::Membrane& membrane) {
  membrane.update_geometry();
  const Surface& surface = membrane.surface();
  if (state_.knows_strain()) {
    state_.start(membrane.positions());
    return;
  }
  harmonics_.analysis(membrane.positions(), coefficients_);
  harmonics_.synthesis(coefficients_, displacement_);
  displacement_ -= membrane.positions();
  conservation_.begin_run();
  conservation_.correct(surface, displacement_);
  positions_ = displacement_ + membrane.positions();
  strain_ = (surface.area_weight() / membrane.target_areas()).log();
  state_.start(positions_, strain_);
}

void FollowedShape::predict(double dt, vesicle::Membrane& membrane) {
  if (!state_.is_known()) start(membrane);
  state_.extrapolate(state_.scheme(dt), predicted_);
  place(predicted_, membrane);
  conservation_.begin_step(dt, membrane);
}

void FollowedShape::place(const Fields& y, vesicle::Membrane& membrane) {
  FollowedState::split(y, positions_, strain_);
  membrane.move_to(positions_, strain_);
}

// Volume and area are kept by the rates already: conserve() alone would add what the implicit terms have not met,
// unlike the increments of the past, an error of first order.
const FollowedShape::Rates& FollowedShape::find_rates(double dt, const Surface& surface, MarkerVelocities& velocities) {
  const MeshMotion::Velocities& moving = mesh_motion_.find(dt, surface, velocities.fluid);
  velocities.membrane = moving.membrane;
  rates_.largest_speed = moving.largest_speed;
  rates_.slip.find(surface, moving.membrane, moving.mesh);
  VectorField& kept = displacement_;
  kept = moving.mesh;
  conservation_.remove_rates(surface, kept);
  rates_.fields.leftCols<3>() = kept;
  if (!state_.has_strain()) return rates_;
  rates_.fields.col(3) = strain_motion_.find_rate(surface, moving.membrane, moving.mesh, strain_);
  if (ties_strain_now()) rates_.fields.col(3) += strain_motion_.missing_rate(surface, kept, strain_);
  return rates_;
}

void FollowedShape::find_membrane_velocity(double dt, const Surface& surface, MarkerVelocities& velocities) {
  velocities.membrane = mesh_motion_.find(dt, surface, velocities.fluid).membrane;
}

void FollowedShape::finish(double dt, Fields& increment, const Fields& second_difference, vesicle::Membrane& membrane) {
  error_.add(state_.scheme(dt), second_difference.leftCols<3>());
  conserve(membrane.surface(), increment);
  symmetry_.apply(increment);
  state_.advance(dt, increment);
  ++steps_;
  place(state_.now(), membrane);
  if (!ties_strain_now()) return;
  state_.shift_strain(mean_strain_.missing(membrane));
  place(state_.now(), membrane);
}

// Replaces the increment of the positions by one that ends at the right volume and area.
void FollowedShape::conserve(const Surface& surface, Fields& increment) {
  if (!conservation_.keeps_something()) return;
  displacement_ = state_.now().leftCols<3>() + increment.leftCols<3>() - surface.positions();
  conservation_.correct(surface, displacement_);
  increment.leftCols<3>() = displacement_ + surface.positions() - state_.now().leftCols<3>();
}

void FollowedShape::restore(double last_dt, std::span<const double> strain, std::span<const double> increment,
                            int smooth_steps, std::span<const double> bend) {
  state_.restore(last_dt, strain, increment);
  error_.restore(smooth_steps, bend);
}

void FollowedShape::restart() {
  state_.restart();
  error_.restart();
}

}  // namespace vesiflow::coupling
