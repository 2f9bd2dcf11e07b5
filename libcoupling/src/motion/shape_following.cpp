// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/shape_following.h"

#include "motion/flat_coefficients.h"
#include "motion/following_history.h"
#include "motion/membrane_condition.h"

namespace vesiflow::coupling {

ShapeFollowing::ShapeFollowing(const FollowingParameters& parameters, const MirrorSymmetry& symmetry,
                               const vesicle::Membrane& membrane)
    : parameters_(parameters),
      shape_(parameters.shape, symmetry, membrane),
      response_(parameters.response()),
      stiffness_(parameters.shape.degrees, parameters.material),
      damping_(parameters.shape.degrees, parameters.shape.radius),
      diagonal_(parameters.shape.degrees),
      solver_(shape_.harmonics(), shape_.state().fields(), parameters.unit_of_length),
      predicted_(shape_.state().now()),
      increment_(predicted_),
      second_difference_(predicted_),
      coefficients_(parameters.shape.degrees, shape_.state().fields()) {
  predicted_coefficients_ = last_coefficients_ = forces_ = coefficients_;
  if (parameters.fluid.has_inertia && !parameters.corrects_fluid)
    owed_.emplace(shape_.harmonics(), shape_.state().fields(), parameters.fluid);
}

// A step up to the fluid: the state whose forces drive it, and what it is owed.
bool ShapeFollowing::predict(double dt, vesicle::Membrane& membrane) {
  const Bdf2 scheme = shape_.state().scheme(dt);
  response_.update(parameters_.fluid.acceleration(dt, scheme), parameters_.fluid.solved_viscosity);
  shape_.predict(dt, membrane);
  if (owed_) owed_->find(dt, scheme, response_, membrane.surface());
  return true;
}

// And from the fluid on.
void ShapeFollowing::advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                             MarkerVelocities& velocities) {
  const vesicle::Surface& surface = membrane.surface();
  const vesicle::SphericalHarmonics& harmonics = shape_.harmonics();
  const Bdf2 scheme = shape_.state().scheme(dt);
  const double r = scheme.ratio;

  // Rates at the predicted state.
  velocity_at(surface.positions(), velocities.fluid);
  const FollowedShape::Rates& rates = shape_.find_rates(dt, surface, velocities);

  // Implicit terms.
  const double radius = parameters_.shape.radius;
  const double inertia = parameters_.fluid.inertia_share(parameters_.fluid.acceleration(dt, scheme), radius);
  const MembraneCondition condition = MembraneCondition::of(membrane, radius);
  stiffness_.find(dt, condition,
                  overestimate_of_single_correction(parameters_.grid.is_thin(), condition.compression, inertia,
                                                    parameters_.fluid.lagging_overestimate()),
                  response_);
  damping_.update(rates.largest_speed);
  diagonal_.find(scheme.leading, stiffness_, damping_);

  // They are solved for the correction d^{k+1} - r d^k, which is small: the right-hand side is (a1 - a0 r) d^k + dt
  // (rates - damping y*).
  shape_.state().extrapolate(scheme, predicted_);
  harmonics.analysis(predicted_, predicted_coefficients_);
  harmonics.analysis(shape_.state().last_increment(), last_coefficients_);
  harmonics.analysis(rates.fields, coefficients_);
  damping_.subtract_from(coefficients_, predicted_coefficients_);
  right_side_ = (scheme.last - scheme.leading * r) * as_vector(last_coefficients_) + dt * as_vector(coefficients_);
  as_vector(coefficients_) = solver_.solve(diagonal_.values(), dt, rates.slip, right_side_);

  // What the fluid has not heard of.
  if (owed_ || parameters_.corrects_fluid) stiffness_.find_forces(coefficients_, forces_);
  if (owed_) owed_->add(forces_);
  if (parameters_.corrects_fluid) find_correcting_force(surface);

  harmonics.synthesis(coefficients_, second_difference_);
  as_vector(coefficients_) += r * as_vector(last_coefficients_);
  harmonics.synthesis(coefficients_, increment_);
  shape_.finish(dt, increment_, second_difference_, membrane);
}

void ShapeFollowing::find_correcting_force(const vesicle::Surface& surface) {
  force_values_.resize(surface.positions().rows(), forces_.fields());
  shape_.harmonics().synthesis(forces_, force_values_);
  correcting_force_ = force_values_.leftCols<3>();
  if (force_values_.cols() == 3) return;
  tension_ = force_values_.col(3);
  surface.projector_divergence(tension_, of_tension_);
  correcting_force_ += of_tension_;
}

void ShapeFollowing::mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) {
  shape_.find_membrane_velocity(dt, membrane.surface(), velocities);
}

std::span<const double> ShapeFollowing::history() const {
  const FollowedState& state = shape_.state();
  if (!state.knows_strain()) return {};  // known already where a history was restored and no step made since
  FollowingHistory history{
      state.last_dt(), 0, shape_.error().steps(), state.strain(), state.increment(), shape_.error().bend(), {}, {}};
  if (owed_) {
    history.owed_steps = owed_->steps();
    history.last_owed = owed_->last();
    history.older_owed = owed_->older();
  }
  history.write(history_);
  return history_;
}

void ShapeFollowing::restore_history(double /*dt*/, std::span<const double> row) {
  const FollowedState& state = shape_.state();
  const FollowingHistory history =
      FollowingHistory::read(row, {state.strain().size(), state.increment().size(), shape_.error().bend().size(),
                                   owed_ ? owed_->last().size() : 0});
  restart();
  shape_.restore(history.last_dt, history.strain, history.increment, history.smooth_steps, history.bend);
  if (owed_) owed_->restore(history.owed_steps, history.last_owed, history.older_owed);
}

void ShapeFollowing::restart() {
  shape_.restart();
  if (owed_) owed_->restart();
}

}  // namespace vesiflow::coupling
