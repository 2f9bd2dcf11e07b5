// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stationarity.h"

#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/QR>

namespace equilibrium {

Stationarity stationarity(const Gradients& gradients) {
  Eigen::MatrixX2d constraints(gradients.area.size(), 2);
  constraints << gradients.area, -gradients.volume;
  const Eigen::Vector2d multipliers = constraints.colPivHouseholderQr().solve(-gradients.energy);
  return {gradients.energy + constraints * multipliers, multipliers[0], multipliers[1]};
}

Directions directions(const Gradients& gradients) {
  const Eigen::Index unknowns = gradients.area.size();
  Eigen::MatrixXd constraints(unknowns, 2);
  constraints << gradients.area, gradients.volume;
  const Eigen::HouseholderQR<Eigen::MatrixXd> factors(constraints);
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
      Eigen::MatrixX2d derivatives(x.size(), 2);
      derivatives << gradients.area / energy.target_area(), gradients.volume / energy.target_volume();
      const Eigen::Matrix2d jacobian = derivatives.transpose() * constrained;
      x -= constrained * jacobian.partialPivLu().solve(errors);
    }
    energy.set(x);
    // The last steps may jitter at rounding of the sums.
    return energy.constraint_errors().lpNorm<Eigen::Infinity>() <= 100 * rounding;
  } catch (const std::domain_error&) {
    return false;  // the mesh degenerated on the way
  }
}

}  // namespace equilibrium
