// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/export.h"
#include "coupling/simulation_parameters.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Marker positions (markers x 3) of a vesicle as it starts.
/// \throws std::logic_error of the vesicle library when the shape cannot be made.
VESIFLOW_COUPLING_EXPORT vesicle::VectorField initial_markers(const VesicleParameters& vesicle, int latitudes);

/// The same for vesicle number i, with a mesh that has a geometry.
/// \throws ParameterError naming what gave the shape of vesicle number i.
VESIFLOW_COUPLING_EXPORT vesicle::VectorField checked_markers(const SimulationParameters& parameters, std::size_t i);

/// Checks that vesicles start apart.
/// \throws ParameterError naming the two when a marker of one vesicle lies inside another.
VESIFLOW_COUPLING_EXPORT void check_apart(const SimulationParameters& parameters);

}  // namespace vesiflow::coupling
