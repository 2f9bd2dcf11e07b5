// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// Reads VesicleParameters::surface from the files of coefficients and meshes; says in the log how well a mesh is fitted.
/// \throws SceneError naming the key when a file cannot be read or makes no surface
void load_surfaces(Scene& scene, const std::string& name);

}  // namespace vesiflow::run
