// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "coupling/marker_integrator.h"

namespace vesiflow::coupling {

/// The integrator "arkode" of make_marker_integrator.
std::unique_ptr<MarkerIntegrator> make_arkode_integrator(std::size_t size, const MarkerTolerances& tolerances);

}  // namespace vesiflow::coupling
