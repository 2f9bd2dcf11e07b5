// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "step/velocity_noise.h"

#include <cmath>
#include <utility>

namespace vesiflow::coupling {

void VelocityNoise::update(const vesicle::VectorField& velocity) {
  speed_ = std::sqrt(velocity.square().rowwise().sum().maxCoeff());
  value_ = 0.0;
  if (known_ >= 2)
    value_ = 0.25 * std::sqrt((velocity - 2.0 * last_ + before_).square().rowwise().sum().maxCoeff(&marker_));
  std::swap(before_, last_);
  last_ = velocity;
  if (known_ < 2) ++known_;
}

}  // namespace vesiflow::coupling
