#pragma once

#include <string>

#include "coupling/scene.h"

namespace vesiflow::coupling {

/// What a run of this scene will do, for people: resolution, memory, solvers, what each step computes and what it
/// skips and why, and what is written how often. Nothing of the size of the grid is allocated.
std::string describe_plan(const Scene& scene, int threads);

/// What to say of a scene that is planned to take more memory than the machine has free, or than the limits set for
/// the program allow; empty if it fits.
std::string memory_warning(const Scene& scene);

}  // namespace vesiflow::coupling
