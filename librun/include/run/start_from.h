// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "run/export.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// Starts `simulation` at t = 0 from the end of a run: membranes with their shapes, places and tensions, the velocity
/// and the pressure of the fluid, taken to its own meshes and grid. `run` is the run's folder or a checkpoint.
/// Parameters are those of the simulation's scene, which must have as many vesicles, of the same effective radius to
/// 1 % (it is the unit of tolerances); what it says of their shapes and places counts no more. For a simulation that
/// has taken no step.
///
/// - Membranes go over by their spherical-harmonic coefficients. Errors of area and volume stay those against the run's
///   own start. Where sigma0 differs, strains are scaled by the ratio, so that tensions stay. Target areas keep the sum
///   that they then have.
/// - Inside the run's box velocity and pressure are interpolated linearly, and the divergence-free part of the velocity
///   is taken; outside, the velocity is what the scene starts with. Walls move as the scene says from the first step
///   on.
/// - Histories of the time integrators are not taken: the first step is of first order, as that of any run.
/// \throws SceneError when there is no usable checkpoint, the numbers of vesicles, a radius or planes of symmetry
/// differ, or a membrane does not fit into the box; the simulation is then of no more use.
VESIFLOW_RUN_EXPORT void start_from(const std::filesystem::path& run, SceneSimulation& simulation);

}  // namespace vesiflow::run
