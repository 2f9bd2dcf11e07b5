#include "implicit_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesiflow::coupling {

using vesicle::Surface;

namespace {

// Z over the rates of MembraneResponse: 3 to 10, as ShapeFollowing has it for stability, takes up to twice the evaluations.
constexpr double best_estimate = 0.75;

}  // namespace

ImplicitMotion::ImplicitMotion(const SimulationParameters& parameters, const Flow& flow, std::size_t vesicle,
                               const vesicle::Membrane& membrane)
    : ShapeFollowing(parameters, flow, vesicle, membrane) {
  overestimate_ = best_estimate;
  const Eigen::Index size = as_vector(coefficients_).size();
  for (Gmres::Vector* v : {&trial_, &improved_, &scales_, &state_coefficients_, &last_coefficients_})
    *v = Gmres::Vector::Zero(size);
}

bool ImplicitMotion::predict(double dt, vesicle::Membrane& membrane) {
  ShapeFollowing::predict(dt, membrane);
  find_scales(dt);
  harmonics_.analysis(state_, coefficients_);
  state_coefficients_ = as_vector(coefficients_);
  harmonics_.analysis(increment_, coefficients_);
  last_coefficients_ = as_vector(coefficients_);
  trial_ = step_ratio(dt) * last_coefficients_;
  has_stiffness_ = false;
  return true;
}

void ImplicitMotion::find_scales(double dt) {
  const double mean_square = std::sqrt(4.0 * std::numbers::pi);
  const double position = 1.0 / (mean_square * radius_);
  const double strain = (1.0 + 0.25 * dt * sigma0_ / length_) / mean_square;
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f) {
        const double scale = f < 3 ? position : strain;
        coefficients_(f, n, m) = {scale, scale};
      }
  scales_ = as_vector(coefficients_);
}

// Z and damping are those of the predicted state through all of the step, so that the equations are the same ones.
void ImplicitMotion::advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
                             MarkerVelocities& velocities) {
  const Surface& surface = membrane.surface();
  velocity_at(surface.positions(), velocities.fluid);
  find_mesh_velocity(dt, surface, velocities);
  velocities.membrane = velocity_;
  find_rates(surface);
  if (!has_stiffness_) {
    largest_tension_ = std::max(0.0, membrane.tension().maxCoeff());
    find_stiffness(dt, surface);
    has_stiffness_ = true;
  }
  harmonics_.analysis(rates_, coefficients_);
  as_vector(predicted_coefficients_) = state_coefficients_ + trial_;
  for (int n = 0; n < harmonics_.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < fields(); ++f)
        coefficients_(f, n, m) -= stiffness_[static_cast<std::size_t>(n)].damping * predicted_coefficients_(f, n, m);
  right_side_ = last_ * last_coefficients_ - leading_ * trial_ + dt * as_vector(coefficients_);
  solve_implicit_terms(dt);
  improved_ = trial_ + solution_;
  ++evaluations_;
}

void ImplicitMotion::get_trial(std::span<double> increment) const {
  Gmres::Vector::Map(increment.data(), trial_.size()) = trial_.cwiseProduct(scales_);
}

void ImplicitMotion::get_improved(std::span<double> increment) const {
  Gmres::Vector::Map(increment.data(), trial_.size()) = improved_.cwiseProduct(scales_);
}

void ImplicitMotion::try_increment(std::span<const double> increment, vesicle::Membrane& membrane) {
  trial_ = Gmres::Vector::Map(increment.data(), trial_.size()).cwiseQuotient(scales_);
  as_vector(coefficients_) = state_coefficients_ + trial_;
  harmonics_.synthesis(coefficients_, predicted_);
  positions_ = predicted_.leftCols<3>();
  if (has_tension()) strain_ = predicted_.col(3);
  membrane.move_to(positions_, strain_);
}

void ImplicitMotion::accept(double dt, std::span<const double> increment, vesicle::Membrane& membrane) {
  as_vector(coefficients_) = Gmres::Vector::Map(increment.data(), trial_.size()).cwiseQuotient(scales_);
  theta_ = -step_ratio(dt) * increment_;
  harmonics_.synthesis(coefficients_, increment_);
  theta_ += increment_;
  finish(dt, membrane);
}

}  // namespace vesiflow::coupling
