// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// What coupling/validity.h says of a scene, for the plan: a warning where the scene is beyond a limit ("  <- WARNING: ... what to do"), else
/// nothing.

/// That of coupling/validity.h with the flow that the scene names; infinite for a program's.
double stable_convection_step(const Scene& scene);

/// Spacing of the markers in those of the grid, of the vesicles that have most and least of it, with its warning.
std::string describe_marker_spacing(const Scene& scene);

/// What is known of sharp membranes, which the limits were not found with.
std::string describe_sharp_region(const Scene& scene);

std::string step_warning(const Scene& scene);     ///< of time.step against the rate of the flow
std::string bending_warning(const Scene& scene);  ///< of time.step against 1/Ca
std::string inertia_warning(const Scene& scene);  ///< of the Reynolds number
std::string memory_limit_warning(const Scene& scene);

}  // namespace vesiflow::run
