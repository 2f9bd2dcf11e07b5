// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "motion/gmres.h"
#include "motion/slip.h"
#include "vesicle/coefficients.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {

/// Solves the implicit terms of a step for an increment x of positions and strain, in coefficients of spherical
/// harmonics (as_vector()):
///   (A_n + dt (D_n + w.grad)) x = b,
/// A_n and the damping D_n diagonal in the degrees, by GMRES on x + (A_n + dt D_n)^{-1} dt w.grad x = (A_n + dt
/// D_n)^{-1} b. What is small of positions is measured in a unit of length that is the simulation's own, so that it does
/// not depend on the one that its parameters are given in.
class IncrementSolver {
 public:
  using Vector = Gmres::Vector;

  struct Diagonal {
    double position = 1.0, strain = 1.0;  ///< A_n for the positions and for the strain
    double damping = 0.0;                 ///< D_n
  };

  /// \param harmonics of the degrees that are kept, which must outlive this
  /// \param fields 3, or 4 with a strain
  IncrementSolver(const vesicle::SphericalHarmonics& harmonics, int fields, double unit_of_length);

  /// \param diagonal per degree
  /// \throws std::domain_error where the slip is too much for a step
  const Vector& solve(std::span<const Diagonal> diagonal, double dt, const Slip& slip, const Vector& right_side);

 private:
  void apply(const Vector& x, Vector& result);

  const vesicle::SphericalHarmonics& harmonics_;
  Gmres gmres_;
  Gmres::Operator operator_;
  Vector units_, inverse_diagonal_, right_side_, solution_;
  vesicle::ScalarField theta_, phi_;  // dt w
  vesicle::Coefficients coefficients_;
  Eigen::ArrayXXd along_theta_, along_phi_;
};

}  // namespace vesiflow::coupling
