// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// What describe_plan() says of the viscosity of the fluid.
struct ViscosityPlan {
  std::string solve;           ///< the velocity solve of a step
  bool is_variable = false;    ///< whether there is a field, an indicator, and the next two lines
  std::string indicator;       ///< how the field is found
  std::string treatment;       ///< of the viscous term
  double indicator_bytes = 0;  ///< of field and indicator
  double fluid_bytes = 0;      ///< of the fluid with its solvers
};

/// Nothing of the size of the grid is allocated.
ViscosityPlan plan_viscosity(const Scene& scene);

}  // namespace vesiflow::run
