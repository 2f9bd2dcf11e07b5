// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <kinsol/kinsol.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sundials/sundials_linearsolver.hpp>
#include <sundials/sundials_matrix.hpp>

#include <cmath>
#include <span>

#include <Eigen/Core>

#include "method.h"
#include "stationarity.h"
#include "sundials_handles.h"

namespace equilibrium {
namespace {

using vesiflow::values;

/// The Euler-Lagrange equation and the constraints for u = (x, tension, pressure), which is the gradient of
/// E + tension (A - A0) - pressure (V - V0).
void evaluate(ConstrainedEnergy& energy, std::span<const double> unknowns, std::span<double> residual) {
  const Eigen::Index n = energy.unknowns();
  const Eigen::Map<const Eigen::VectorXd> u(unknowns.data(), n + 2);
  Eigen::Map<Eigen::VectorXd> result(residual.data(), n + 2);
  energy.set(u.head(n));
  const Gradients& gradients = energy.gradients();
  result.head(n) = gradients.energy + u[n] * gradients.area - u[n + 1] * gradients.volume;
  result[n] = energy.functionals().area - energy.target_area();
  result[n + 1] = energy.target_volume() - energy.functionals().volume;
}

}  // namespace

SolverReport minimise_by_kinsol(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  using Function = vesiflow::SundialsFunction<>;
  const Eigen::Index n = energy.unknowns();
  const auto size = static_cast<std::size_t>(n + 2);
  const vesiflow::SundialsContext context = vesiflow::make_sundials_context();
  const vesiflow::SundialsVector u = vesiflow::make_sundials_vector(size, context);
  const vesiflow::SundialsVector scale = vesiflow::make_sundials_vector(size, context);
  const sundials::experimental::SUNMatrixView jacobian(SUNDenseMatrix(n + 2, n + 2, context));
  const sundials::experimental::SUNLinearSolverView solver(SUNLinSol_Dense(u, jacobian, context));
  const vesiflow::SundialsMemory<KINFree> kinsol(KINCreate(context));

  energy.set(x);
  const Stationarity start = stationarity(energy.gradients());
  Eigen::Map<Eigen::VectorXd>(values(u).data(), n + 2) << x, start.tension, start.pressure;
  N_VConst(1.0, scale);  // unknowns and residuals are of order one

  // A degenerate mesh has no residual: a shorter step may.
  Function system(
      [&energy](std::span<const double> unknowns, std::span<double> residual) { evaluate(energy, unknowns, residual); },
      Function::DomainErrors::try_nearer);
  vesiflow::SundialsMessage message;
  const int limit = options.limit(200);
  KINSetErrHandlerFn(kinsol.get(), vesiflow::SundialsMessage::keep, &message);
  KINInit(kinsol.get(), Function::call, u);
  KINSetUserData(kinsol.get(), &system);
  KINSetLinearSolver(kinsol.get(), solver, jacobian);  // Jacobian by differences
  // KINSOL takes the largest entry; half, because area and volume are made exact afterwards.
  KINSetFuncNormTol(kinsol.get(), 0.5 * options.tolerance / std::sqrt(double(n + 2)));
  KINSetScaledStepTol(kinsol.get(), 1e-15);
  KINSetNumMaxIters(kinsol.get(), limit);
  KINSetMaxSetupCalls(kinsol.get(), 1);  // a new Jacobian for every step
  KINSetMaxNewtonStep(kinsol.get(), 10.0);
  const int status = KINSol(kinsol.get(), u, KIN_LINESEARCH, scale, scale);
  system.rethrow();

  SolverReport report;
  long iterations = 0;
  KINGetNumNonlinSolvIters(kinsol.get(), &iterations);
  report.iterations = static_cast<int>(iterations);
  x = Eigen::Map<const Eigen::VectorXd>(values(u).data(), n);
  energy.set(x);
  const Directions bases = directions(energy.constraint_gradients());
  const bool on_target = retract(energy, bases.constrained, x);
  report.residual = on_target ? stationarity(energy.gradients()).residual.norm() : HUGE_VAL;
  if (options.progress) options.progress({report.iterations, energy.functionals().energy, report.residual});
  report.converged = report.residual <= options.tolerance;
  if (!report.converged)
    report.obstacle = message.text.empty() ? "KINSOL stopped, code " + std::to_string(status)
                                           : message.function + ": " + message.text;
  return report;
}

}  // namespace equilibrium
