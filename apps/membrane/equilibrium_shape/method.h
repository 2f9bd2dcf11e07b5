// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "constrained_energy.h"

namespace equilibrium {

enum class Method {
  newton,         ///< Newton's method on the manifold of given area and volume; built in
  gradient_flow,  ///< steepest descent on that manifold, Barzilai-Borwein steps; built in
  kinsol,         ///< SUNDIALS KINSOL: Newton with line search for unknowns and multipliers together
  cvode,          ///< SUNDIALS CVODE: the gradient flow in time, Adams-Moulton of variable order and step
};

/// All of them, with the names of the command line; and the one of a name.
const std::vector<std::pair<std::string, Method>>& methods();
std::string name_of(Method method);

/// One line of progress.
struct Iteration {
  int number = 0;
  double energy = 0;
  double residual = 0;  ///< norm of Stationarity::residual
};

struct SolverOptions {
  double tolerance = 1e-9;  ///< on the norm of Stationarity::residual; the energy's error is about its square
  int most_iterations = 0;  ///< 0: the method's own limit
  /// The most iterations to make, where the method's own limit is `own`.
  int limit(int own) const { return most_iterations > 0 ? most_iterations : own; }
  std::function<void(const Iteration&)> progress;
};

/// Not converging is no exception: `obstacle` then says what happened.
struct SolverReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;
  std::string obstacle;
};

/// The build has no SUNDIALS. The message names the option of the build.
class MethodMissing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Minimises from the shape x, which has the right area and volume, and leaves x at the best shape found, with `energy` set to
/// it. Nothing of the methods depends on which branch x lies on.
/// @throws MethodMissing
SolverReport minimise(Method method, ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options);

/// Relative changes of the energy that a coarse mesh need not get right: steps that promise less are taken without
/// comparing energies.
inline constexpr double settled_change = 1e-8;

SolverReport minimise_by_newton(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options);
SolverReport minimise_by_gradient_flow(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options);
SolverReport minimise_by_kinsol(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options);
SolverReport minimise_by_cvode(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options);

}  // namespace equilibrium
