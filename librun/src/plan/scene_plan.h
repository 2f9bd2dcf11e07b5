// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// describe_plan() without what depends on the machine and the moment: what all of it takes against what is free.
std::string describe_scene_plan(const Scene& scene, int threads);

}  // namespace vesiflow::run
