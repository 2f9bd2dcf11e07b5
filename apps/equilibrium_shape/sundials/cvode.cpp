#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "handles.h"
#include "method.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

constexpr int most_iterations = 2000;

struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
using NonlinearSolverHandle = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, FreeNonlinearSolver>;

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
  const NonlinearSolverHandle solver(SUNNonlinSol_FixedPoint(state.get(), 0, context.get()));
  const std::unique_ptr<void, FreeCvode> cvode(CVodeCreate(CV_ADAMS, context.get()));
  values(state.get()) = x;

  // Only the end of the path matters: loose on the way, and tight enough that the state can settle.
  constexpr double relative_tolerance = 1e-3;
  // The flow's times are about one in the unknowns of Meridian: it is not stiff. (BDF with a dense Jacobian takes five to
  // eight times as long.)
  constexpr double first_step = 0.01, far_future = 1e6;
  std::string message;
  CVodeSetErrHandlerFn(cvode.get(), keep_message, &message);
  CVodeInit(cvode.get(), evaluate, 0.0, state.get());
  CVodeSStolerances(cvode.get(), relative_tolerance, options.tolerance);
  CVodeSetInitStep(cvode.get(), first_step);
  CVodeSetUserData(cvode.get(), &energy);
  CVodeSetNonlinearSolver(cvode.get(), solver.get());

  SolverReport report;
  const int limit = options.most_iterations > 0 ? options.most_iterations : most_iterations;
  Eigen::VectorXd rate(n);
  for (;; ++report.iterations) {
    x = values(state.get());
    velocity(energy, x, Eigen::Map<Eigen::VectorXd>(rate.data(), n));
    report.residual = rate.norm();
    if (options.progress) options.progress({report.iterations, energy.functionals().energy, report.residual});
    if (report.residual <= 0.5 * options.tolerance || report.iterations == limit) break;
    double time = 0;
    const int status = CVode(cvode.get(), far_future, state.get(), &time, CV_ONE_STEP);
    if (status < 0) {
      report.obstacle = message.empty() ? "CVODE stopped, code " + std::to_string(status) : message;
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
