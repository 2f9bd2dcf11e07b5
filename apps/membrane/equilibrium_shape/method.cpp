// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "method.h"

#include <stdexcept>

namespace equilibrium {

const std::vector<std::pair<std::string, Method>>& methods() {
  static const std::vector<std::pair<std::string, Method>> all = {{"newton", Method::newton},
                                                                  {"gradient_flow", Method::gradient_flow},
                                                                  {"kinsol", Method::kinsol},
                                                                  {"cvode", Method::cvode}};
  return all;
}

std::string name_of(Method method) {
  for (const auto& [name, value] : methods())
    if (value == method) return name;
  throw std::logic_error("a method without a name");
}

SolverReport minimise(Method method, ConstrainedEnergy& energy, Eigen::VectorXd& x, const SolverOptions& options) {
  switch (method) {
    case Method::newton:
      return minimise_by_newton(energy, x, options);
    case Method::gradient_flow:
      return minimise_by_gradient_flow(energy, x, options);
    case Method::kinsol:
      return minimise_by_kinsol(energy, x, options);
    case Method::cvode:
      return minimise_by_cvode(energy, x, options);
  }
  throw std::logic_error("unknown method");
}

}  // namespace equilibrium
