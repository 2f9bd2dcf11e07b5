#pragma once

#include <algorithm>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// Greatest effective radius of the vesicles: what lengths of the scene are large or small against.
inline double largest_radius(const Scene& scene) {
  double radius = 0.0;
  for (const VesicleScene& vesicle : scene.vesicles) radius = std::max(radius, vesicle.radius);
  return radius;
}

/// Reynolds number of the largest vesicle in the unit of time of the scene: rho r^2/(mu t), whatever the unit of length. 0 without inertia.
inline double vesicle_reynolds_number(const Scene& scene) {
  const double radius = largest_radius(scene);
  return scene.fluid.inertia == fluid::Inertia::none ? 0.0 : scene.fluid.reynolds_number * radius * radius;
}

/// Capillary number of a vesicle in the unit of time of the scene and its own radius: mu r^3/(c_b t), whatever the unit of length.
inline double own_capillary_number(const Scene& scene, std::size_t vesicle) {
  const double radius = scene.vesicles[vesicle].radius;
  return scene.capillary_number(vesicle) * radius * radius * radius;
}

}  // namespace vesiflow::coupling
