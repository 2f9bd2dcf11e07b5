// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "method.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

/// Second variation of E + tension A - pressure V in the free directions, shape (free, free), by differences of its
/// gradient: one gradient evaluation per direction. The error of the differences (about 1e-6) makes Newton's
/// convergence linear with that factor, which saves the last iteration at most.
Eigen::MatrixXd second_variation(ConstrainedEnergy& energy, const Eigen::VectorXd& x, const Stationarity& at_x,
                                 const Eigen::MatrixXd& free) {
  constexpr double difference = 1e-6;
  Eigen::MatrixXd result(free.cols(), free.cols());
  for (Eigen::Index k = 0; k < free.cols(); ++k) {
    energy.set(x + difference * free.col(k));
    const Gradients& there = energy.gradients();
    const Eigen::VectorXd gradient = there.energy + at_x.tension * there.area - at_x.pressure * there.volume;
    result.col(k) = free.transpose() * (gradient - at_x.residual) / difference;
  }
  return (result + result.transpose()) / 2;
}

/// Newton's step, with the moduli of the eigenvalues so that it always descends and never settles on a saddle.
Eigen::VectorXd descent(const Eigen::MatrixXd& second_variation, const Eigen::VectorXd& gradient) {
  constexpr double smallest = 1e-3;  // the moduli are about one
  constexpr double longest = 2;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(second_variation);
  const Eigen::ArrayXd moduli = solver.eigenvalues().array().abs().max(smallest);
  const Eigen::ArrayXd components = (solver.eigenvectors().transpose() * gradient).array();
  const Eigen::VectorXd step = -(solver.eigenvectors() * (components / moduli).matrix());
  return step * std::min(1.0, longest / step.norm());
}

}  // namespace

SolverReport minimise_by_newton(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  const int limit = options.limit(60);
  SolverReport report;
  for (;; ++report.iterations) {
    energy.set(x);
    const Gradients gradients = energy.gradients();
    const double here = energy.functionals().energy;
    const Stationarity now = stationarity(gradients);
    report.residual = now.residual.norm();
    if (options.progress) options.progress({report.iterations, here, report.residual});
    report.converged = report.residual <= options.tolerance;
    if (report.converged) return report;
    if (report.iterations == limit) {
      report.obstacle = "the limit of iterations was reached";
      return report;
    }

    Eigen::VectorXd step, free_gradient;
    const Directions bases = directions(gradients);
    free_gradient = bases.free.transpose() * now.residual;
    step = descent(second_variation(energy, x, now, bases.free), free_gradient);
    const double slope = step.dot(free_gradient);

    // Halve until the energy falls as it should.
    constexpr double sufficient = 1e-4;
    constexpr double shortest = 1e-4;
    const bool settled = -slope < settled_change * here;
    Eigen::VectorXd next;
    double fraction = 1;
    for (; fraction > shortest; fraction /= 2) {
      next = x + fraction * (bases.free * step);
      if (retract(energy, bases.constrained, next) &&
          (settled || energy.functionals().energy <= here + sufficient * fraction * slope))
        break;
    }
    if (fraction <= shortest) {
      energy.set(x);
      report.obstacle = "no step along Newton's direction lowers the energy";
      return report;
    }
    x = next;
  }
}

}  // namespace equilibrium
