#pragma once

#include <string>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// What a run of this scene will do, for people: resolution, memory, solvers, what each step computes and what it
/// skips and why, and what is written how often. Nothing of the size of the grid is allocated.
std::string describe_plan(const Scene& scene, int threads);

}  // namespace vesiflow::coupling
