// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/export.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// Adds the force per area (markers x 3) of a fluid inside that is heavier than that outside by the force density
/// `weight` = density_difference times gravity: f = (weight . (X - C)) n, C the mean of the membrane's points. The
/// uniform weight inside is the gradient of a pressure, so all it does is this jump of pressure across the membrane
/// (another C changes the pressure inside by a constant); its total is weight times the volume, by the divergence
/// theorem. The difference in inertia is left out, as it is in the fluid, whose density is one.
/// \throws std::invalid_argument unless `force` has a row for each marker.
VESIFLOW_COUPLING_EXPORT void add_buoyancy(const vesicle::Surface& surface, const vesicle::Vector3& weight,
                                           vesicle::VectorField& force);

}  // namespace vesiflow::coupling
