// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// coupling.method of a scene that does not name it: "sharp", whose error is of second order in the spacing, where it can be computed
/// and is known to be quiet; "delta" elsewhere, and where its correction is the cheaper way to the same error
/// (docs/coupling.md#which-method).

/// Why membranes of this scene should be coupled by delta functions, in words for its plan; empty if they should be sharp.
std::string why_delta(const Scene& scene);

/// Chooses.
void choose_coupling_method(Scene& scene);

/// One line for the plan: the method, and whether the other one would have been chosen.
std::string describe_coupling_method(const Scene& scene);

}  // namespace vesiflow::run
