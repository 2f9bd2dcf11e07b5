// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "vesicle/sphere_grid.h"

namespace vesiflow::vesicle {

/// Unit vector of longitude i and colatitude j.
inline Vector3 direction(const SphereGrid& grid, int i, int j) {
  const double phi = grid.longitude(i);
  const double s = grid.sin_colatitude()[j];
  return {s * std::cos(phi), s * std::sin(phi), grid.cos_colatitude()[j]};
}

}  // namespace vesiflow::vesicle
