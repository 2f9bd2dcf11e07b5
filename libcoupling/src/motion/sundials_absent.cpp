// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Stands in for arkode_integrator.cpp and fixed_point.cpp in builds without SUNDIALS.
#include <stdexcept>

#include "motion/arkode_integrator.h"
#include "motion/fixed_point.h"

namespace vesiflow::coupling {

bool have_sundials() {
  return false;
}

std::unique_ptr<MarkerIntegrator> make_arkode_integrator(std::size_t, const MarkerTolerances&) {
  throw std::invalid_argument(
      "marker integrator 'arkode': this build has no SUNDIALS; configure with -DVESIFLOW_WITH_SUNDIALS=ON");
}

std::unique_ptr<FixedPoint> make_fixed_point(std::size_t, const FixedPoint::Limits&) {
  throw std::invalid_argument(
      "the implicit step: this build has no SUNDIALS; configure with -DVESIFLOW_WITH_SUNDIALS=ON");
}

}  // namespace vesiflow::coupling
