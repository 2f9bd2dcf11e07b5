#pragma once

#include <string>

#include "coupling/scene.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Marker positions (markers x 3) of a vesicle as the scene starts it.
/// \throws std::logic_error of the vesicle library when the shape cannot be made
vesicle::VectorField initial_markers(const VesicleScene& vesicle, int latitudes);

/// The same, with a mesh that has a geometry.
/// \throws SceneError naming the key that gave the shape of vesicle number i
vesicle::VectorField checked_markers(const Scene& scene, std::size_t i, const std::string& name);

/// Reads VesicleScene::surface from the files of coefficients and meshes; says in the log how well a mesh is fitted.
/// \throws SceneError naming the key when a file cannot be read or makes no surface
void load_surfaces(Scene& scene, const std::string& name);

/// \throws SceneError naming the two when a marker of one vesicle lies inside another
void check_apart(const Scene& scene, const std::string& name);

}  // namespace vesiflow::coupling
