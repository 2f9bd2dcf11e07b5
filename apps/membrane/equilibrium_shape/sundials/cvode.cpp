// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sundials/sundials_nonlinearsolver.hpp>

#include <cmath>
#include <span>

#include <Eigen/LU>

#include "method.h"
#include "stationarity.h"
#include "sundials_handles.h"

namespace equilibrium {
namespace {

using vesiflow::values;

/// dx/dt = -residual - C (C^T C)^{-1} c: down the gradient along the constraints c = 0, with gradients C, and back to them at
/// unit rate.
void velocity(ConstrainedEnergy& energy, const Eigen::VectorXd& x, Eigen::Map<Eigen::VectorXd> result) {
  energy.set(x);
  const Gradients& gradients = energy.gradients();
  Eigen::MatrixX2d derivatives(x.size(), 2);
  derivatives << gradients.area / energy.target_area(), gradients.volume / energy.target_volume();
  const Eigen::Matrix2d squares = derivatives.transpose() * derivatives;
  result = -stationarity(gradients).residual - derivatives * squares.inverse() * energy.constraint_errors();
}

}  // namespace

SolverReport minimise_by_cvode(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  using Function = vesiflow::SundialsFunction<double>;
  const Eigen::Index n = energy.unknowns();
  const vesiflow::SundialsContext context = vesiflow::make_sundials_context();
  const vesiflow::SundialsVector state = vesiflow::make_sundials_vector(static_cast<std::size_t>(n), context);
  const sundials::experimental::SUNNonlinearSolverView solver(SUNNonlinSol_FixedPoint(state, 0, context));
  const vesiflow::SundialsMemory<CVodeFree> cvode(CVodeCreate(CV_ADAMS, context));
  Eigen::Map<Eigen::VectorXd>(values(state).data(), n) = x;

  // Only the end of the path matters: loose on the way, and tight enough that the state can settle.
  constexpr double relative_tolerance = 1e-3;
  // The flow's times are about one in the unknowns of Meridian: it is not stiff. (BDF with a dense Jacobian takes five to
  // eight times as long.)
  constexpr double first_step = 0.01, far_future = 1e6;
  // A degenerate mesh has no velocity: the end of a shorter step may.
  Function flow(
      [&energy, n](double /*time*/, std::span<const double> at, std::span<double> result) {
        velocity(energy, Eigen::Map<const Eigen::VectorXd>(at.data(), n), {result.data(), n});
      },
      Function::DomainErrors::try_nearer);
  vesiflow::SundialsMessage message;
  CVodeSetErrHandlerFn(cvode.get(), vesiflow::SundialsMessage::keep, &message);
  CVodeInit(cvode.get(), Function::call, 0.0, state);
  CVodeSStolerances(cvode.get(), relative_tolerance, options.tolerance);
  CVodeSetInitStep(cvode.get(), first_step);
  CVodeSetUserData(cvode.get(), &flow);
  CVodeSetNonlinearSolver(cvode.get(), solver);

  SolverReport report;
  const int limit = options.limit(2000);
  Eigen::VectorXd rate(n);
  for (;; ++report.iterations) {
    x = Eigen::Map<const Eigen::VectorXd>(values(state).data(), n);
    velocity(energy, x, Eigen::Map<Eigen::VectorXd>(rate.data(), n));
    report.residual = rate.norm();
    if (options.progress) options.progress({report.iterations, energy.functionals().energy, report.residual});
    if (report.residual <= 0.5 * options.tolerance || report.iterations == limit) break;
    double time = 0;
    const int status = CVode(cvode.get(), far_future, state, &time, CV_ONE_STEP);
    flow.rethrow();
    if (status < 0) {
      report.obstacle = message.text.empty() ? "CVODE stopped, code " + std::to_string(status)
                                             : message.function + ": " + message.text;
      break;
    }
  }
  // Half of the tolerance is left for this: the flow meets area and volume as well as its own tolerance only.
  const Directions bases = directions(energy.constraint_gradients());
  if (!retract(energy, bases.constrained, x)) report.obstacle = "the flow left the shapes with this area and volume";
  report.residual = stationarity(energy.gradients()).residual.norm();
  report.converged = report.obstacle.empty() && report.residual <= options.tolerance;
  if (!report.converged && report.obstacle.empty()) report.obstacle = "the limit of iterations was reached";
  return report;
}

}  // namespace equilibrium
