// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "run/export.h"
#include "run/scene.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// Writes what a continued run needs, the scene included (HDF5). The file appears complete or not at all.
/// \throws FileError when it cannot be written.
VESIFLOW_RUN_EXPORT void write_checkpoint(const std::filesystem::path& file, const SceneSimulation& simulation);

/// The scene a checkpoint was made with, the surfaces of shapes from files included: those files need not exist any
/// more.
/// \throws SceneError when the file cannot be read or an override is refused.
VESIFLOW_RUN_EXPORT Scene read_checkpoint_scene(const std::filesystem::path& file, const Overrides& overrides = {});

/// All that a checkpoint says.
struct CheckpointContents {
  Scene scene;                      ///< the scene
  coupling::SimulationState state;  ///< the state
};
/// Reads all that a checkpoint says.
/// \throws SceneError when the file cannot be read or is damaged.
VESIFLOW_RUN_EXPORT CheckpointContents read_checkpoint(const std::filesystem::path& file);

/// Puts `simulation` in the state of the checkpoint: from there it goes on bit for bit as the run that wrote it.
/// \throws SceneError when the file is unreadable or damaged, or naming the key when the two scenes differ in anything
/// but title, time.end, limits and output.
VESIFLOW_RUN_EXPORT void restore_checkpoint(const std::filesystem::path& file, SceneSimulation& simulation);

}  // namespace vesiflow::run
