// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "check.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {

/// The grid, of as many latitudes as surfaces have. Throws std::invalid_argument otherwise.
inline const SphereGrid& checked(const SphereGrid& grid) {
  check_argument(grid.latitudes() >= 4 && grid.latitudes() <= Surface::largest_latitudes, "latitudes", grid.latitudes(),
                 "in [4, 512]");
  return grid;
}

}  // namespace vesiflow::vesicle
