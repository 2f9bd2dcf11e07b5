// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/snapshot_series.h"
#include "run/scene_simulation.h"

namespace vesiflow::run {

/// Snapshots of the membranes, and of the fluid at cell centres (docs/results.md), of the simulation as it is when they are
/// written: it must live as long as its series.
SnapshotSeries::Kind vesicle_snapshots(SceneSimulation& simulation);
SnapshotSeries::Kind fluid_snapshots(const SceneSimulation& simulation);

}  // namespace vesiflow::run
