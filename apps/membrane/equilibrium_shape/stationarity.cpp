// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stationarity.h"

#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/QR>

namespace equilibrium {
namespace {

// The gradients of area and volume, side by side.
Eigen::MatrixXd constrained_columns(const Gradients& gradients) {
  Eigen::MatrixXd result(gradients.area.size(), 2);
  result << gradients.area, gradients.volume;
  return result;
}

}  // namespace

Stationarity stationarity(const Gradients& gradients) {
  const Eigen::MatrixXd constraints = constrained_columns(gradients);
  const Eigen::VectorXd multipliers = constraints.householderQr().solve(-gradients.energy);
  return {gradients.energy + constraints * multipliers, multipliers[0], -multipliers[1]};
}

Directions directions(const Gradients& gradients) {
  const Eigen::Index unknowns = gradients.area.size();
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(constrained_columns(gradients));
  const Eigen::MatrixXd q = factors.householderQ() * Eigen::MatrixXd::Identity(unknowns, unknowns);
  return {q.leftCols(2), q.rightCols(unknowns - 2)};
}

bool retract(ConstrainedEnergy& energy, const Eigen::MatrixXd& constrained, Eigen::VectorXd& x) {
  constexpr int most_steps = 12;
  constexpr double rounding = 1e-14;
  try {
    for (int step = 0; step < most_steps; ++step) {
      energy.set(x);
      const Eigen::Vector2d errors = energy.constraint_errors();
      if (!errors.allFinite()) return false;
      if (errors.lpNorm<Eigen::Infinity>() <= rounding) return true;
      const Gradients& gradients = energy.constraint_gradients();
      Eigen::Matrix2d jacobian;
      jacobian << constrained.transpose() * gradients.area / energy.target_area(),
          constrained.transpose() * gradients.volume / energy.target_volume();
      x -= constrained * (jacobian.transpose().inverse() * errors);
    }
    energy.set(x);
    // The last steps may jitter at rounding of the sums.
    return energy.constraint_errors().lpNorm<Eigen::Infinity>() <= 100 * rounding;
  } catch (const std::domain_error&) {
    return false;  // the mesh degenerated on the way
  }
}

}  // namespace equilibrium
