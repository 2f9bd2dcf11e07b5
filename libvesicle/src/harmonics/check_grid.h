// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <stdexcept>

#include "vesicle/sphere_grid.h"

namespace vesiflow::vesicle {

/// Throws std::invalid_argument unless what is called `name` lives on the grid that it must.
inline void check_grid(const SphereGrid& found, const char* name, const SphereGrid& wanted) {
  if (found == wanted) return;
  std::ostringstream message;
  message << name << " is on another grid: " << found.latitudes() << " latitudes with " << found.longitudes()
          << " longitudes: must be " << wanted.latitudes() << " with " << wanted.longitudes();
  throw std::invalid_argument(message.str());
}

}  // namespace vesiflow::vesicle
