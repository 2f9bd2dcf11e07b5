// What a continued run of shape following needs beside the positions: its last step, and the corrections that the fluid is still owed.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "shape_following.h"

namespace vesiflow::coupling {

using vesicle::Coefficients;

std::span<const double> ShapeFollowing::history() const {
  if (!knows_strain_) return {};  // known already where a history was restored and no step made since
  history_.assign({previous_dt_, static_cast<double>(corrections_), static_cast<double>(smooth_steps_)});
  const auto append = [this](const double* values, Eigen::Index size) {
    history_.insert(history_.end(), values, values + size);
  };
  append(state_.data() + 3 * state_.rows(), state_.size() - 3 * state_.rows());
  append(increment_.data(), increment_.size());
  append(curvature_of_path_.data(), curvature_of_path_.size());
  if (has_inertia_)
    for (const Coefficients* correction : {&correction_, &older_correction_})
      append(reinterpret_cast<const double*>(correction->block(0, 0)),
             Eigen::Index(correction->fields()) * correction->degrees() * (correction->degrees() + 1));
  return history_;
}

void ShapeFollowing::restore_history(double /*dt*/, std::span<const double> history) {
  const auto strains = static_cast<std::size_t>(state_.size() - 3 * state_.rows());
  const auto increments = static_cast<std::size_t>(increment_.size());
  const auto impulses = has_inertia_ ? static_cast<std::size_t>(as_vector(correction_).size()) : 0;
  const auto markers = static_cast<std::size_t>(curvature_of_path_.size());
  const std::size_t size = 3 + strains + increments + markers + 2 * impulses;
  if (history.size() != size)
    throw std::invalid_argument("shape_following: a history of " + std::to_string(history.size()) +
                                " values, expected " + std::to_string(size));
  const auto is_count = [](double value) { return value >= 0.0 && value <= 1e9; };
  if (!(history[0] >= 0.0) || !is_count(history[1]) || !is_count(history[2]))
    throw std::invalid_argument("shape_following: a history of a step of " + std::to_string(history[0]) +
                                " with counts " + std::to_string(history[1]) + " and " + std::to_string(history[2]) +
                                ": must be >= 0, the counts <= 1e9");
  restart();
  previous_dt_ = history[0];
  corrections_ = static_cast<int>(history[1]);
  smooth_steps_ = static_cast<int>(history[2]);
  const double* values = history.data() + 3;
  const auto take = [&values](std::size_t count, double* to) {
    std::copy_n(values, count, to);
    values += count;
  };
  take(strains, state_.data() + 3 * state_.rows());
  knows_strain_ = true;
  take(increments, increment_.data());
  take(markers, curvature_of_path_.data());
  if (!has_inertia_) return;
  take(impulses, as_vector(correction_).data());
  take(impulses, as_vector(older_correction_).data());
}

void ShapeFollowing::restart() {
  knows_state_ = knows_strain_ = false;
  previous_dt_ = 0.0;
  smooth_steps_ = 0;
  corrections_ = 0;
  owes_ = false;
  increment_.setZero();
  correction_.set_zero();
  older_correction_.set_zero();
  position_error_.reset();
}

}  // namespace vesiflow::coupling
