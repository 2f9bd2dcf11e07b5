// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/followed_state.h"

#include <algorithm>

namespace vesiflow::coupling {

FollowedState::FollowedState(Eigen::Index markers, bool has_strain)
    : now_(Fields::Zero(markers, has_strain ? 4 : 3)), last_increment_(Fields::Zero(markers, now_.cols())) {}

void FollowedState::start(const vesicle::VectorField& positions, const vesicle::ScalarField& strain) {
  if (has_strain()) now_.col(3) = strain;
  start(positions);
}

void FollowedState::start(const vesicle::VectorField& positions) {
  now_.leftCols<3>() = positions;
  knows_positions_ = knows_strain_ = true;
}

void FollowedState::advance(double dt, const Fields& increment) {
  last_increment_ = increment;
  now_ += increment;
  last_dt_ = dt;
}

void FollowedState::shift_strain(double shift) {
  last_increment_.col(3) += shift;
  now_.col(3) += shift;
}

void FollowedState::split(const Fields& y, vesicle::VectorField& positions, vesicle::ScalarField& strain) {
  positions = y.leftCols<3>();
  if (y.cols() > 3)
    strain = y.col(3);
  else
    strain.setZero(y.rows());
}

std::span<const double> FollowedState::strain() const {
  const Eigen::Index of_positions = 3 * now_.rows();
  return {now_.data() + of_positions, static_cast<std::size_t>(now_.size() - of_positions)};
}

std::span<const double> FollowedState::increment() const {
  return {last_increment_.data(), static_cast<std::size_t>(last_increment_.size())};
}

void FollowedState::restore(double last_dt, std::span<const double> strain, std::span<const double> increment) {
  std::ranges::copy(strain, now_.data() + 3 * now_.rows());
  std::ranges::copy(increment, last_increment_.data());
  last_dt_ = last_dt;
  knows_positions_ = false;
  knows_strain_ = true;
}

void FollowedState::restart() {
  knows_positions_ = knows_strain_ = false;
  last_dt_ = 0.0;
  last_increment_.setZero();
}

}  // namespace vesiflow::coupling
