#include <cvode/cvode.h>

#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "handles.h"
#include "method.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

constexpr int most_iterations = 2000;

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

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

int evaluate(double /*time*/, N_Vector x, N_Vector result, void* user) {
  try {
    velocity(*static_cast<ConstrainedEnergy*>(user), values(x), values(result));
    return 0;
  } catch (const std::domain_error&) {
    return 1;  // a degenerate mesh: try a shorter step
  }
}

}  // namespace

SolverReport minimise_by_cvode(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  const Eigen::Index n = energy.unknowns();
  const ContextHandle context = make_context();
  const VectorHandle state(N_VNew_Serial(n, context.get()));
  const MatrixHandle jacobian(SUNDenseMatrix(n, n, context.get()));
  const LinearSolverHandle solver(SUNLinSol_Dense(state.get(), jacobian.get(), context.get()));
  const std::unique_ptr<void, FreeCvode> cvode(CVodeCreate(CV_BDF, context.get()));
  values(state.get()) = x;

  // Only the end of the path matters: loose on the way, and tight enough that the state can settle.
  constexpr double relative_tolerance = 1e-4;
  std::string message;
  CVodeSetErrHandlerFn(cvode.get(), keep_message, &message);
  CVodeInit(cvode.get(), evaluate, 0.0, state.get());
  CVodeSStolerances(cvode.get(), relative_tolerance, options.tolerance);
  CVodeSetUserData(cvode.get(), &energy);
  CVodeSetLinearSolver(cvode.get(), solver.get(), jacobian.get());  // Jacobian by differences

  SolverReport report;
  const int limit = options.most_iterations > 0 ? options.most_iterations : most_iterations;
  Eigen::VectorXd current = x;
  for (; report.iterations <= limit; ++report.iterations) {
    x = current;
    energy.set(x);
    const Directions bases = directions(energy.constraint_gradients());
    if (!retract(energy, bases.constrained, x)) {
      report.obstacle = "the flow left the shapes with this area and volume";
      break;
    }
    report.residual = stationarity(energy.gradients()).residual.norm();
    if (options.progress) options.progress({report.iterations, energy.functionals().energy, report.residual});
    report.converged = report.residual <= options.tolerance;
    if (report.converged) return report;
    double time = 0;
    const int status = CVode(cvode.get(), HUGE_VAL, state.get(), &time, CV_ONE_STEP);
    if (status < 0) {
      report.obstacle = message.empty() ? "CVODE stopped, code " + std::to_string(status) : message;
      return report;
    }
    current = values(state.get());
  }
  if (report.obstacle.empty()) report.obstacle = "the limit of iterations was reached";
  return report;
}

}  // namespace equilibrium
