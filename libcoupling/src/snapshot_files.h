#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "coupling/simulation.h"

namespace vesiflow::coupling {

/// Snapshots of the membranes: vesicle.h5 with vesicle.xdmf beside it for ParaView.
class VesicleSnapshots {
 public:
  explicit VesicleSnapshots(std::filesystem::path directory);
  void write(Simulation& simulation);
  /// Forgets snapshots after the present step: a restarted run writes them again.
  void rewind(const Simulation& simulation);
  long last_step() const { return steps_.empty() ? -1 : steps_.rbegin()->first; }

 private:
  std::filesystem::path directory_;
  std::map<long, double> steps_;  // step -> time, of what the file holds
};

/// Snapshots of the fluid at cell centres: fluid.h5 with fluid.xdmf.
class FluidSnapshots {
 public:
  explicit FluidSnapshots(std::filesystem::path directory);
  void write(const Simulation& simulation);
  void rewind(const Simulation& simulation);
  long last_step() const { return steps_.empty() ? -1 : steps_.rbegin()->first; }

 private:
  std::filesystem::path directory_;
  std::map<long, double> steps_;
};

}  // namespace vesiflow::coupling
