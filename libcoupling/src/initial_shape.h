#pragma once

#include <string>

#include "coupling/scene.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Marker positions (markers x 3) of a vesicle as the scene starts it.
vesicle::VectorField initial_markers(const VesicleScene& vesicle, int latitudes);

/// \throws SceneError naming the two when a marker of one vesicle lies inside another
void check_apart(const Scene& scene, const std::string& name);

}  // namespace vesiflow::coupling
