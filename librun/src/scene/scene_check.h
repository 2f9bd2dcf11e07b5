// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// check_scene() with the flow that the simulation has, which may be a program's.
void check_scene(const Scene& scene, const coupling::Flow& flow, const std::string& name);

/// \throws SceneError when membrane.g and membrane.sigma0 disagree
void check_tension_number(const Scene& scene, const std::string& name);

}  // namespace vesiflow::run
