// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "coupling/export.h"
#include "fluid/grid.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// Whether any of the markers (markers x 3) lies inside the surface or on it, by the solid angle under which it sees
/// the surface. The surface must be up to date. `shift` is added to the markers. Costs the product of the numbers of
/// markers where their bounds meet, and nothing where they do not.
VESIFLOW_COUPLING_EXPORT bool overlap(const vesicle::Surface& surface, const vesicle::VectorField& markers,
                                      const vesicle::Vector3& shift = vesicle::Vector3::Zero());

/// For each membrane the least distance between its markers and those of any other, images by periods and in mirror
/// planes included (of itself too); infinite where there is no other. All arrays are (markers x 3).
VESIFLOW_COUPLING_EXPORT std::vector<double> nearest_distances(const fluid::Grid& grid,
                                                               std::span<const vesicle::VectorField* const> membranes);

/// The least distance of markers (markers x 3) in the box to its walls; infinite without walls.
VESIFLOW_COUPLING_EXPORT double distance_to_walls(const fluid::Grid& grid, const vesicle::VectorField& markers);

}  // namespace vesiflow::coupling
