// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/path_error.h"

#include <algorithm>
#include <cmath>

#include "motion/constants.h"

namespace vesiflow::coupling {

PathError::PathError(Eigen::Index markers)
    : bend_(vesicle::VectorField::Zero(markers, 3)), last_bend_(vesicle::VectorField::Zero(markers, 3)) {}

void PathError::add(const Bdf2& scheme, const Eigen::Ref<const vesicle::VectorField>& second_difference) {
  constexpr int steps_before_a_third_difference = 2;
  const double r = scheme.ratio;
  value_.reset();
  bend_ = (r > 0.0 ? 2.0 * r / (1.0 + r) : 1.0) * second_difference;
  if (steps_ >= steps_before_a_third_difference) {
    const double squares = (bend_ - r * r * last_bend_).square().sum();
    value_ = constants::bdf2_error * std::sqrt(squares / static_cast<double>(bend_.rows()));
  }
  last_bend_ = bend_;
  ++steps_;
}

std::span<const double> PathError::bend() const {
  return {last_bend_.data(), static_cast<std::size_t>(last_bend_.size())};
}

void PathError::restore(int steps, std::span<const double> bend) {
  std::ranges::copy(bend, last_bend_.data());
  steps_ = steps;
  value_.reset();
}

void PathError::restart() {
  steps_ = 0;
  value_.reset();
}

}  // namespace vesiflow::coupling
