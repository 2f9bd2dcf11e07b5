// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "coupling/repulsion.h"
#include "coupling/simulation.h"
#include "coupling/simulation_parameters.h"
#include "fluid/grid.h"
#include "step/immersed_vesicle.h"

namespace vesiflow::coupling {

/// The forces on membranes that are not their own: buoyancy, repulsion, and those of a program. Costs nothing where there are none.
class ExternalForces {
 public:
  /// \param own forces that the program adds
  ExternalForces(const SimulationParameters& parameters, const fluid::Grid& grid,
                 std::span<const std::unique_ptr<ImmersedVesicle>> vesicles, std::span<const MembraneForce> own);

  /// Whether there are some; without, there is nothing to compute().
  bool any() const { return !repelled_.empty(); }

  /// Sets ImmersedVesicle::force of all vesicles, whose own forces are up to date.
  void compute(double time);

  /// Force of all membranes on the fluid, component by component, with what their motions owe it.
  fluid::Vector3 total() const;

 private:
  std::span<const std::unique_ptr<ImmersedVesicle>> vesicles_;
  std::vector<vesicle::Vector3> weights_;  // density difference times gravity; empty without gravity
  std::span<const MembraneForce> own_;
  std::optional<Repulsion> repulsion_;
  std::vector<RepelledMembrane> repelled_;
};

}  // namespace vesiflow::coupling
