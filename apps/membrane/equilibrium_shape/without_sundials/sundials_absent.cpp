// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// In the place of sundials/ in builds without it.
#include "method.h"

namespace equilibrium {
namespace {

[[noreturn]] void refuse(Method method) {
  throw MethodMissing("--method " + name_of(method) +
                      ": not in this build; configure with -DVESIFLOW_WITH_SUNDIALS=ON, or use newton or "
                      "gradient_flow");
}

}  // namespace

SolverReport minimise_by_kinsol(ConstrainedEnergy&, Eigen::VectorXd&, const SolverOptions&) {
  refuse(Method::kinsol);
}

SolverReport minimise_by_cvode(ConstrainedEnergy&, Eigen::VectorXd&, const SolverOptions&) {
  refuse(Method::cvode);
}

}  // namespace equilibrium
