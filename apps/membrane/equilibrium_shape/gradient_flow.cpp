// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>

#include "method.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

/// Barzilai and Borwein's step (doi:10.1093/imanum/8.1.141): the inverse of the mean curvature of the energy along the
/// last step.
double next_step_size(const Eigen::VectorXd& moved, const Eigen::VectorXd& residual_change) {
  const double curvature = moved.dot(residual_change) / moved.squaredNorm();
  constexpr double least = 0.05, most = 20;  // the eigenvalues of the second variation are about one
  return curvature > 0 ? std::clamp(1 / curvature, least, most) : 1;
}

}  // namespace

SolverReport minimise_by_gradient_flow(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  const int limit = options.limit(2000);
  SolverReport report;
  double step_size = 0.2;
  std::deque<double> last_energies;
  Eigen::VectorXd last_x, last_residual;
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

    // These steps are not monotone: compare with the largest of the last energies (Grippo, Lampariello, Lucidi).
    constexpr std::size_t memory = 6;
    constexpr double sufficient = 1e-4;
    constexpr double shortest = 1e-6;
    last_energies.push_back(here);
    if (last_energies.size() > memory) last_energies.pop_front();
    const double ceiling = *std::max_element(last_energies.begin(), last_energies.end()) * (1 + 1e-14);
    if (report.iterations > 0) step_size = next_step_size(x - last_x, now.residual - last_residual);
    last_x = x;
    last_residual = now.residual;
    const Directions bases = directions(gradients);
    for (; step_size > shortest; step_size /= 2) {
      x = last_x - step_size * now.residual;
      const double slope = -now.residual.squaredNorm();
      const bool settled = -slope * step_size < settled_change * here;
      if (retract(energy, bases.constrained, x) &&
          (settled || energy.functionals().energy <= ceiling + sufficient * step_size * slope))
        break;
    }
    if (step_size <= shortest) {
      x = last_x;
      energy.set(x);
      report.obstacle = "no step against the gradient lowers the energy";
      return report;
    }
  }
}

}  // namespace equilibrium
