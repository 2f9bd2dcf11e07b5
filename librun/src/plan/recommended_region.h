#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// What docs/stability.md, Recommended region, says of a scene: limits, and for the plan a warning where the scene is beyond one ("  <- WARNING:
/// ... what to do"), else nothing.

/// The longest step that follows bending: a shape far from rest relaxes at a rate of about 1/Ca (docs/stability.md, reduced volume and capillary
/// number). Of the stiffest vesicle; Ca r^3 is its own number where its radius is not 1.
double coupling::stable_bending_step(const Scene& scene);

/// The largest g = dt sigma0/(4 h) at which shape following is quiet where inertia counts (docs/time_integration.md, shape_following); infinite
/// elsewhere.
double coupling::quiet_tension_number(const Scene& scene);

/// Spacing of the markers in those of the grid, of the vesicles that have most and least of it, with its warning.
std::string describe_marker_spacing(const Scene& scene);

std::string step_warning(const Scene& scene);     ///< of time.step against the rate of the flow
std::string bending_warning(const Scene& scene);  ///< of time.step against 1/Ca
std::string inertia_warning(const Scene& scene);  ///< of the Reynolds number
std::string memory_limit_warning(const Scene& scene);

}  // namespace vesiflow::run
