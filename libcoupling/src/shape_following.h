#pragma once

#include <memory>

#include "membrane_motion.h"

namespace vesiflow::coupling {

/// time.markers = "shape_following": docs/time_integration.md.
std::unique_ptr<MembraneMotion> make_shape_following(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane);

}  // namespace vesiflow::coupling
