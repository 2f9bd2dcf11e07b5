// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/implicit_motion.h"

#include <cmath>
#include <numbers>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"
#include "motion/following_history.h"
#include "motion/membrane_condition.h"

namespace vesiflow::coupling {

ImplicitMotion::ImplicitMotion(const FollowingParameters& parameters, const MirrorSymmetry& symmetry,
                               const vesicle::Membrane& membrane)
    : parameters_(parameters),
      shape_(parameters.shape, symmetry, membrane),
      response_(parameters.response()),
      stiffness_(parameters.shape.degrees, parameters.material),
      damping_(parameters.shape.degrees, parameters.shape.radius),
      diagonal_(parameters.shape.degrees),
      solver_(shape_.harmonics(), shape_.state().fields(), parameters.unit_of_length),
      fields_(shape_.state().now()),
      increment_(fields_),
      coefficients_(parameters.shape.degrees, shape_.state().fields()),
      trial_state_(coefficients_) {
  const Eigen::Index size = as_vector(coefficients_).size();
  for (Vector* v : {&state_, &last_increment_, &trial_, &improved_, &scales_}) *v = Vector::Zero(size);
  if (parameters.fluid.has_inertia) nothing_owed_.assign(static_cast<std::size_t>(size), 0.0);
}

bool ImplicitMotion::predict(double dt, vesicle::Membrane& membrane) {
  const Bdf2 scheme = shape_.state().scheme(dt);
  response_.update(parameters_.fluid.acceleration(dt, scheme), parameters_.fluid.solved_viscosity);
  shape_.predict(dt, membrane);
  find_scales(dt);
  shape_.harmonics().analysis(shape_.state().now(), coefficients_);
  state_ = as_vector(coefficients_);
  shape_.harmonics().analysis(shape_.state().last_increment(), coefficients_);
  last_increment_ = as_vector(coefficients_);
  trial_ = scheme.ratio * last_increment_;
  has_implicit_terms_ = false;
  return true;
}

// The strain of a wave of the length of the unit, k = 1, relaxes at the rate sigma0 k^2 over 4 mu k in Stokes flow.
void ImplicitMotion::find_scales(double dt) {
  const double mean_square = std::sqrt(4.0 * std::numbers::pi);
  const double position = 1.0 / (mean_square * parameters_.shape.radius);
  const double strain = (1.0 + 0.25 * dt * parameters_.material.sigma0 / parameters_.unit_of_length) / mean_square;
  for_each_coefficient(coefficients_, [&](auto& value, int field, int) {
    const double scale = field < 3 ? position : strain;
    value = {scale, scale};
  });
  scales_ = as_vector(coefficients_);
}

void ImplicitMotion::advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                             MarkerVelocities& velocities) {
  const Bdf2 scheme = shape_.state().scheme(dt);
  velocity_at(membrane.surface().positions(), velocities.fluid);
  const FollowedShape::Rates& rates = shape_.find_rates(dt, membrane.surface(), velocities);
  if (!has_implicit_terms_) {
    stiffness_.find(dt, MembraneCondition::of(membrane, parameters_.shape.radius),
                    {.factor = constants::overestimate_of_implicit_motion, .covers_compression = true}, response_);
    damping_.update(rates.largest_speed);
    diagonal_.find(scheme.leading, stiffness_, damping_);
    has_implicit_terms_ = true;
  }
  shape_.harmonics().analysis(rates.fields, coefficients_);
  as_vector(trial_state_) = state_ + trial_;
  damping_.subtract_from(coefficients_, trial_state_);
  right_side_ = scheme.last * last_increment_ - scheme.leading * trial_ + dt * as_vector(coefficients_);
  improved_ = trial_ + solver_.solve(diagonal_.values(), dt, rates.slip, right_side_);
  ++evaluations_;
}

void ImplicitMotion::mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) {
  shape_.find_membrane_velocity(dt, membrane.surface(), velocities);
}

void ImplicitMotion::get_trial(std::span<double> increment) const {
  Vector::Map(increment.data(), trial_.size()) = trial_.cwiseProduct(scales_);
}

void ImplicitMotion::get_improved(std::span<double> increment) const {
  Vector::Map(increment.data(), trial_.size()) = improved_.cwiseProduct(scales_);
}

void ImplicitMotion::try_increment(std::span<const double> increment, vesicle::Membrane& membrane) {
  trial_ = Vector::Map(increment.data(), trial_.size()).cwiseQuotient(scales_);
  as_vector(trial_state_) = state_ + trial_;
  shape_.harmonics().synthesis(trial_state_, fields_);
  shape_.place(fields_, membrane);
}

void ImplicitMotion::accept(double dt, std::span<const double> increment, vesicle::Membrane& membrane) {
  as_vector(coefficients_) = Vector::Map(increment.data(), trial_.size()).cwiseQuotient(scales_);
  shape_.harmonics().synthesis(coefficients_, increment_);
  FollowedShape::Fields& second_difference = fields_;
  second_difference = -shape_.state().scheme(dt).ratio * shape_.state().last_increment();
  second_difference += increment_;
  shape_.finish(dt, increment_, second_difference, membrane);
}

std::span<const double> ImplicitMotion::history() const {
  const FollowedState& state = shape_.state();
  if (!state.knows_strain()) return {};
  const FollowingHistory history{state.last_dt(),        0,
                                 shape_.error().steps(), state.strain(),
                                 state.increment(),      shape_.error().bend(),
                                 nothing_owed_,          nothing_owed_};
  history.write(history_);
  return history_;
}

void ImplicitMotion::restore_history(double /*dt*/, std::span<const double> row) {
  const FollowedState& state = shape_.state();
  const FollowingHistory history = FollowingHistory::read(
      row, {state.strain().size(), state.increment().size(), shape_.error().bend().size(), nothing_owed_.size()});
  restart();
  shape_.restore(history.last_dt, history.strain, history.increment, history.smooth_steps, history.bend);
}

}  // namespace vesiflow::coupling
