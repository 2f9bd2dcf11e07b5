// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sampled_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "expansion_geometry.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

using namespace vesiflow::vesicle;

Coefficients SampledSurface::expansion(int degrees) const {
  return expansion_of(*this, degrees);
}

Reference SampledSurface::reference(const SphereGrid& nodes) const {
  const auto evaluate = [&](int degrees) { return ExpansionGeometry(degrees, nodes).at_nodes(expansion(degrees)); };
  Reference result;
  result.degrees = std::clamp(4 * nodes.latitudes(), 256, 512);
  try {
    result.values = evaluate(result.degrees);
    result.estimate = max_difference(result.values, evaluate(result.degrees / 4 * 3));
  } catch (const std::domain_error& error) {
    throw InputError(fmt::format("{}: {}", name(), error.what()));
  }
  return result;
}

void SampledSurface::require_closed_and_outward() const {
  Surface surface(64);
  try {
    surface.update(sample(surface.grid()));
  } catch (const std::domain_error& error) {
    throw InputError(fmt::format("{}: {}", name(), error.what()));
  }
  // Not 0: a surface that turns back on itself encloses nothing but rounding.
  constexpr double smallest_reduced_volume = 1e-3;
  if (!(surface.volume() > 0) || reduced_volume(surface.area(), surface.volume()) < smallest_reduced_volume)
    throw InputError(
        fmt::format("{}: the volume is {:.3g} with an area of {:.3g}: must be > 0 (reduced volume >= {}); X_theta x "
                    "X_phi must point outward, with theta the angle from the north pole and phi turning eastward",
                    name(), surface.volume(), surface.area(), smallest_reduced_volume));
}
