#include <kinsol/kinsol.h>

#include <cmath>
#include <stdexcept>

#include "handles.h"
#include "method.h"
#include "stationarity.h"

namespace equilibrium {
namespace {

constexpr int most_iterations = 200;

struct FreeKinsol {
  void operator()(void* memory) const { KINFree(&memory); }
};

/// The Euler-Lagrange equation and the constraints for u = (x, tension, pressure), which is the gradient of
/// E + tension (A - A0) - pressure (V - V0).
struct System {
  ConstrainedEnergy& energy;

  void evaluate(const Eigen::VectorXd& u, Eigen::Map<Eigen::VectorXd> result) {
    const Eigen::Index n = energy.unknowns();
    energy.set(u.head(n));
    const Gradients& gradients = energy.gradients();
    result.head(n) = gradients.energy + u[n] * gradients.area - u[n + 1] * gradients.volume;
    result[n] = energy.functionals().area - energy.target_area();
    result[n + 1] = energy.target_volume() - energy.functionals().volume;
  }
};

int evaluate(N_Vector u, N_Vector result, void* user) {
  try {
    static_cast<System*>(user)->evaluate(values(u), values(result));
    return 0;
  } catch (const std::domain_error&) {
    return 1;  // a degenerate mesh: try a shorter step
  }
}

}  // namespace

SolverReport minimise_by_kinsol(ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  const Eigen::Index n = energy.unknowns();
  const ContextHandle context = make_context();
  const VectorHandle u(N_VNew_Serial(n + 2, context.get()));
  const VectorHandle scale(N_VNew_Serial(n + 2, context.get()));
  const MatrixHandle jacobian(SUNDenseMatrix(n + 2, n + 2, context.get()));
  const LinearSolverHandle solver(SUNLinSol_Dense(u.get(), jacobian.get(), context.get()));
  const std::unique_ptr<void, FreeKinsol> kinsol(KINCreate(context.get()));

  energy.set(x);
  const Stationarity start = stationarity(energy.gradients());
  values(u.get()) << x, start.tension, start.pressure;
  N_VConst(1.0, scale.get());  // unknowns and residuals are of order one

  System system{energy};
  std::string message;
  const int limit = options.most_iterations > 0 ? options.most_iterations : most_iterations;
  KINSetErrHandlerFn(kinsol.get(), keep_message, &message);
  KINInit(kinsol.get(), evaluate, u.get());
  KINSetUserData(kinsol.get(), &system);
  KINSetLinearSolver(kinsol.get(), solver.get(), jacobian.get());  // Jacobian by differences
  // KINSOL takes the largest entry; half, because area and volume are made exact afterwards.
  KINSetFuncNormTol(kinsol.get(), 0.5 * options.tolerance / std::sqrt(double(n + 2)));
  KINSetScaledStepTol(kinsol.get(), 1e-15);
  KINSetNumMaxIters(kinsol.get(), limit);
  KINSetMaxSetupCalls(kinsol.get(), 1);  // a new Jacobian for every step
  KINSetMaxNewtonStep(kinsol.get(), 10.0);
  const int status = KINSol(kinsol.get(), u.get(), KIN_LINESEARCH, scale.get(), scale.get());

  SolverReport report;
  long iterations = 0;
  KINGetNumNonlinSolvIters(kinsol.get(), &iterations);
  report.iterations = static_cast<int>(iterations);
  x = values(u.get()).head(n);
  energy.set(x);
  const Directions bases = directions(energy.constraint_gradients());
  const bool on_target = retract(energy, bases.constrained, x);
  report.residual = on_target ? stationarity(energy.gradients()).residual.norm() : HUGE_VAL;
  if (options.progress) options.progress({report.iterations, energy.functionals().energy, report.residual});
  report.converged = report.residual <= options.tolerance;
  if (!report.converged) report.obstacle = message.empty() ? "KINSOL stopped, code " + std::to_string(status) : message;
  return report;
}

}  // namespace equilibrium
