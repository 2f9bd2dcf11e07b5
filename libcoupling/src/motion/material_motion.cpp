// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/material_motion.h"

#include <stdexcept>
#include <utility>

namespace vesiflow::coupling {

MaterialMotion::MaterialMotion(const Parameters& parameters, std::unique_ptr<MarkerIntegrator> integrator,
                               const MirrorSymmetry& symmetry, const vesicle::Membrane& membrane)
    : parameters_(parameters),
      symmetry_(symmetry),
      positions_(membrane.positions()),
      displacement_(positions_),
      integrator_(std::move(integrator)) {
  if (parameters_.estimates_error) error_.emplace(positions_.rows());
  filtered_velocity_ = [this](double fraction, std::span<const double> state, std::span<double> velocity) {
    evaluate(fraction, Eigen::Map<const vesicle::VectorField>(state.data(), positions_.rows(), 3));
    Eigen::Map<vesicle::VectorField>(velocity.data(), positions_.rows(), 3) = step_.velocities->membrane;
  };
}

void MaterialMotion::advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                             MarkerVelocities& velocities) {
  step_ = {dt, &velocity_at, &membrane, &velocities};
  positions_ = membrane.positions();
  integrator_->advance(dt, filtered_velocity_, {positions_.data(), static_cast<std::size_t>(positions_.size())});
  displacement_ = positions_ - membrane.positions();
  // The velocities that go with the whole step, and not with the last stage of it.
  if (parameters_.has_stages) {
    positions_ = membrane.positions() + 0.5 * displacement_;
    evaluate(0.5, positions_);
  }
  membrane.correct_displacement(displacement_);
  symmetry_.apply(displacement_);
  positions_ = membrane.positions() + displacement_;
  membrane.advance(positions_, velocities.fluid, velocities.membrane, dt);
  if (error_) error_->add(dt, displacement_);
}

void MaterialMotion::mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) {
  membrane.filter_velocity(velocities.fluid, dt, velocities.membrane);
}

// Normals, areas and volume are those of the start of the step in all its stages.
void MaterialMotion::evaluate(double fraction, const VelocityAt::Positions& positions) {
  (*step_.velocity_at)(parameters_.interpolates_in_time ? fraction : 1.0, positions, step_.velocities->fluid);
  mesh_velocity(step_.dt, *step_.membrane, *step_.velocities);
}

std::span<const double> MaterialMotion::history() const {
  const auto of_integrator = integrator_->history();
  if (!error_ || !error_->has_history()) return of_integrator;
  history_.assign(of_integrator.begin(), of_integrator.end());
  const vesicle::VectorField& of_error = error_->history();
  history_.insert(history_.end(), of_error.data(), of_error.data() + of_error.size());
  return history_;
}

void MaterialMotion::restore_history(double dt, std::span<const double> history) {
  if (error_) {
    const auto size = static_cast<std::size_t>(positions_.size());
    if (history.size() < size) throw std::invalid_argument("the history of the markers is too short");
    const std::size_t rest = history.size() - size;
    error_->restore_history(dt, Eigen::Map<const vesicle::VectorField>(history.data() + rest, positions_.rows(), 3));
    history = history.first(rest);
  }
  if (!history.empty()) integrator_->restore_history(dt, history);
}

void MaterialMotion::restart() {
  integrator_->restart();
  if (error_) error_->restart();
}

}  // namespace vesiflow::coupling
