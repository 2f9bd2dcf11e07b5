// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "run/export.h"
#include "run/scene.h"

namespace vesiflow::run {

/// What a run of this scene will do, for people: resolution, memory, solvers, what each step computes and what it skips
/// and why, what is written how often, and what all of it takes of time, memory and the disk that `directory` is on.
/// Nothing of the size of the grid is allocated.
VESIFLOW_RUN_EXPORT std::string describe_plan(const Scene& scene, int threads,
                                              const std::filesystem::path& directory = ".");

/// What to say of a scene that is planned to take more memory than the machine has free, or than the limits set for
/// the program allow; empty if it fits.
VESIFLOW_RUN_EXPORT std::string memory_warning(const Scene& scene);

}  // namespace vesiflow::run
