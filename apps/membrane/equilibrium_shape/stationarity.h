// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "constrained_energy.h"

namespace equilibrium {

/// The part of the energy's gradient that area and volume do not hold, and the multipliers that hold the rest:
///   residual = dE + tension dA - pressure dV, of least norm over tension and pressure.
/// At an equilibrium the residual vanishes, which is f_b + pressure - 2 H tension = 0 on the membrane. Both multipliers are in
/// units of c_b / r^2 and c_b / r^3 (energy (c_b / 2) int H^2 dA); in Helfrich's kappa = c_b / 4 they are 4 times as large.
struct Stationarity {
  Eigen::VectorXd residual;
  double tension = 0, pressure = 0;
};
Stationarity stationarity(const Gradients& gradients);

/// Orthonormal directions that change area and volume (2 columns) and those that keep both to first order, shape
/// (unknowns, unknowns - 2).
struct Directions {
  Eigen::MatrixXd constrained, free;
};
Directions directions(const Gradients& gradients);

/// Brings area and volume back to their targets, to rounding, by Newton steps in the `constrained` directions; leaves
/// the energy at the new x. False if that fails; x is then unspecified.
bool retract(ConstrainedEnergy& energy, const Eigen::MatrixXd& constrained, Eigen::VectorXd& x);

}  // namespace equilibrium
