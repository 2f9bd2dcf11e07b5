// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/increment_solver.h"

#include <stdexcept>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"

namespace vesiflow::coupling {

IncrementSolver::IncrementSolver(const vesicle::SphericalHarmonics& harmonics, int fields, double unit_of_length)
    : harmonics_(harmonics),
      gmres_(constants::most_slip_iterations),
      operator_([this](const Vector& x, Vector& result) { apply(x, result); }),
      coefficients_(harmonics.degrees(), fields),
      along_theta_(harmonics.grid().size(), fields),
      along_phi_(harmonics.grid().size(), fields) {
  for_each_coefficient(coefficients_, [&](auto& value, int field, int) {
    const double unit = field < 3 ? unit_of_length : 1.0;
    value = {unit, unit};
  });
  units_ = as_vector(coefficients_);
}

const IncrementSolver::Vector& IncrementSolver::solve(std::span<const Diagonal> diagonal, double dt, const Slip& slip,
                                                      const Vector& right_side) {
  theta_ = dt * slip.theta;
  phi_ = dt * slip.phi;
  for_each_coefficient(coefficients_, [&](auto& value, int field, int n) {
    const Diagonal& d = diagonal[static_cast<std::size_t>(n)];
    const double inverse = 1.0 / ((field < 3 ? d.position : d.strain) + dt * d.damping);
    value = {inverse, inverse};
  });
  inverse_diagonal_ = as_vector(coefficients_);
  right_side_ = right_side;
  right_side_.array() *= inverse_diagonal_.array() / units_.array();
  const Gmres::Report report = gmres_.solve(operator_, right_side_, constants::slip_tolerance, solution_);
  solution_.array() *= units_.array();
  if (!(report.residual < constants::worst_slip_residual))
    throw std::domain_error(
        "the implicit slip of the mesh was not found: the membrane is swept along by too many of its waves in a "
        "step; reduce time.step");
  return solution_;
}

// x + (A_n + dt D_n)^{-1} dt w.grad x.
void IncrementSolver::apply(const Vector& x, Vector& result) {
  as_vector(coefficients_) = x;
  harmonics_.gradient(coefficients_, along_theta_, along_phi_);
  for (Eigen::Index f = 0; f < along_theta_.cols(); ++f)
    along_theta_.col(f) = theta_ * along_theta_.col(f) + phi_ * along_phi_.col(f);
  harmonics_.analysis(along_theta_, coefficients_);
  result = as_vector(coefficients_);
  result.array() *= inverse_diagonal_.array();
  result += x;
}

}  // namespace vesiflow::coupling
