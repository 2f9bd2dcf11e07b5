#include "geometry_accuracy/sampled_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "geometry_accuracy/expansion_geometry.h"
#include "vesicle/surface.h"

using namespace vesiflow::vesicle;

Coefficients SampledSurface::expansion(int degrees) const {
  return expansion_of(*this, degrees);
}

Reference SampledSurface::reference(const SphereGrid& nodes) const {
  const auto evaluate = [&](int degrees) {
    return ExpansionGeometry(degrees, nodes).at_nodes(expansion(degrees));
  };
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
  if (!(surface.volume() > 0))
    throw InputError(
        fmt::format("{}: the volume is {:.6g}: must be > 0; X_theta x X_phi must point outward (theta is the angle "
                    "from the north pole, phi turns eastward)",
                    name(), surface.volume()));
}
