// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene.h"

namespace vesiflow::run {

/// What a plan says of sharp membranes (coupling.method = "sharp"), and what they take.

/// Solves of the fluid in a step (of markers = "implicit": in each evaluation): 1, 2 where it is corrected, and what the
/// velocities of membranes between two viscosities take by experience.
double fluid_solves(const Scene& scene);

std::string describe_jumps(const Scene& scene);
std::string describe_interface_passes(const Scene& scene);

/// Bytes of the points of the grid near the membranes, and of the meshes that they are looked up on.
double sharp_bytes(const Scene& scene);
/// One number at each point of the boxes that the phases at vesicles of another viscosity are kept in.
double body_box_bytes(const Scene& scene);

}  // namespace vesiflow::run
