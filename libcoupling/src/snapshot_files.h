#pragma once

#include "coupling/simulation.h"
#include "snapshot_series.h"

namespace vesiflow::coupling {

/// Snapshots of the membranes, and of the fluid at cell centres (docs/results.md), of the simulation as it is when they are
/// written: it must live as long as its series.
SnapshotSeries::Kind vesicle_snapshots(Simulation& simulation);
SnapshotSeries::Kind fluid_snapshots(const Simulation& simulation);

}  // namespace vesiflow::coupling
