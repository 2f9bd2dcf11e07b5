// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// parse_scene with another way to fill in coupling::VesicleParameters::surface, between reading the keys and checking the scene.
Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides,
                  const std::function<void(Scene&)>& load_surfaces);

}  // namespace vesiflow::run
