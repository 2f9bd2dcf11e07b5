// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "coupling/simulation.h"
#include "run/scene.h"

namespace vesiflow::run {

/// Of all that a run goes on from, by value. HDF5's own checksums name what is damaged in a file, but take zeros with a
/// checksum of zero, as a lost block reads, for sound; nor do they cover how the parts belong together.
std::int64_t checksum_of(const coupling::SimulationState& state);

/// Of a scene as its text and the surfaces that came from files.
std::int64_t checksum_of(const Scene& scene, const std::string& text);

}  // namespace vesiflow::run
