// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// method.accuracy: what a target for the largest relative error (position, angle, frequency, deformation) asks of grid, mesh and step,
/// found by bench/studies/work_precision.py and verified on scenes that were not used to find it (docs/performance.md#presets).

/// Sets domain.cells, mesh.latitudes, time.step, membrane.sigma0, time.markers and coupling.thickness_correction to what the target asks
/// for; nothing where there is none. The box, the flow and the vesicles must be known.
void apply_accuracy(Scene& scene);

/// \throws coupling::ParameterError where no settings are known that meet the target
void check_accuracy(const Scene& scene);

/// One line for the plan: the settings, and what in the scene is coarser or beyond what was verified.
std::string describe_accuracy(const Scene& scene);

}  // namespace vesiflow::run
