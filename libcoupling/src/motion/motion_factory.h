#pragma once

#include <cstddef>
#include <memory>

#include "coupling/scene.h"
#include "motion/membrane_motion.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// The motion that time.markers names, for the membrane of that vesicle of the scene.
std::unique_ptr<MembraneMotion> make_membrane_motion(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane);

}  // namespace vesiflow::coupling
