// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "coupling/mistakes.h"
#include "run/scene.h"

namespace vesiflow::run {

/// check_scene() with the flow that the simulation has, which may be a program's.
void check_scene(const Scene& scene, const coupling::Flow& flow, const std::string& name);

/// What is wrong with the keys that only scenes have. The others are parameters, which coupling::check() checks.
coupling::Mistakes mistakes_of_scene_keys(const Scene& scene);

/// Adds what coupling::check() has found, by the keys that a scene has for it.
void add_by_key(const coupling::ParameterError& found, const Scene& scene, coupling::Mistakes& mistakes);

/// flow_of() to check a scene with. Where the domain has no volume, of which not every flow can be made, it is another one: the check
/// refuses the domain whatever flows in it.
coupling::Flow flow_to_check(const Scene& scene);

}  // namespace vesiflow::run
