// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/start_control.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "motion/constants.h"
#include "vesicle/rigid_motion.h"

namespace vesiflow::coupling {

// Parts end exactly with the step.
double StartControl::next(double time, double end, double step) const {
  if (level_ > 0 && position_ + (whole_step >> level_) == whole_step) return end - time;
  return std::ldexp(step, -level_);
}

void StartControl::shorten() {
  ++level_;
  calm_parts_ = 0;
}

bool StartControl::accepts(double change, long steps) const {
  if (level_ == 0) return change <= constants::largest_first_change;
  return change <= constants::largest_part_change || steps >= constants::longest_start;
}

bool StartControl::advance(double change, long steps) {
  position_ += whole_step >> level_;
  if (level_ > 0) ++parts_;
  const bool is_calm = change <= constants::calm_part_change || steps >= constants::longest_start;
  calm_parts_ = is_calm ? calm_parts_ + 1 : 0;
  if (level_ > 0 && calm_parts_ >= constants::calm_parts_to_grow && position_ % (whole_step >> (level_ - 1)) == 0) {
    --level_;
    calm_parts_ = 0;
  }
  if (position_ < whole_step) return false;
  position_ = 0;
  return true;
}

std::vector<double> StartControl::state() const {
  if (parts_ == 0) return {};
  return {static_cast<double>(level_), static_cast<double>(calm_parts_), static_cast<double>(parts_)};
}

void StartControl::restore(std::span<const double> state) {
  constexpr double many = 1e9;
  *this = {};
  if (state.empty()) return;
  const auto is_count = [](double value, double most) {
    return value >= 0.0 && value <= most && value == std::floor(value);
  };
  if (state.size() != 3 || !is_count(state[0], finest_level) || !is_count(state[1], many) || !is_count(state[2], many))
    throw std::invalid_argument("the state of the start control is not one");
  level_ = static_cast<int>(state[0]);
  calm_parts_ = static_cast<int>(state[1]);
  parts_ = static_cast<long>(state[2]);
}

vesicle::ScalarField total_curvature(const vesicle::Surface& surface) {
  return (4.0 * surface.mean_curvature().square() - 2.0 * surface.gaussian_curvature()).max(0.0).sqrt();
}

double rate_of_shape(const vesicle::Surface& surface, const vesicle::VectorField& velocity,
                     const vesicle::ScalarField& curvature) {
  const vesicle::VectorField& n = surface.normal();
  const vesicle::ScalarField along = (velocity * n).rowwise().sum();
  const vesicle::RigidMotion rigid = vesicle::rigid_motion_of_shape(surface, along);
  double largest = 0.0;
  for (Eigen::Index m = 0; m < along.size(); ++m) {
    std::array<double, 3> r;
    for (int i = 0; i < 3; ++i) r[i] = surface.positions()(m, i) - rigid.centre(i);
    double rest = along(m);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      rest -= (rigid.velocity(i) + rigid.angular_velocity(j) * r[k] - rigid.angular_velocity(k) * r[j]) * n(m, i);
    }
    const double rate = std::abs(rest) * curvature(m);
    if (!(rate <= largest)) largest = rate;  // not finite: stays so
  }
  return largest;
}

}  // namespace vesiflow::coupling
