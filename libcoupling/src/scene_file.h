#pragma once

#include <functional>
#include <string>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// parse_scene with another way to fill in VesicleScene::surface, between reading the keys and checking the scene.
Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides,
                  const std::function<void(Scene&)>& load_surfaces);

}  // namespace vesiflow::coupling
