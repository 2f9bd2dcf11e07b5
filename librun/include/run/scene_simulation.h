// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/simulation.h"
#include "run/export.h"
#include "run/scene.h"

namespace vesiflow::run {

/// The simulation of a scene.
class VESIFLOW_RUN_EXPORT SceneSimulation : public coupling::Simulation {
 public:
  /// As the scene starts, with the flow it names.
  /// \throws SceneError for a scene that cannot be computed.
  explicit SceneSimulation(const Scene& scene);
  /// The same with a boundary velocity of one's own instead of the scene's flow (flow.type becomes "custom"); it is
  /// also the initial velocity if flow.start = "flow".
  /// \param motion whether the velocity depends on time.
  /// \throws SceneError for a scene that cannot be computed.
  SceneSimulation(const Scene& scene, const fluid::BoundaryVelocity& flow, fluid::WallMotion motion);
  /// The same with all that a flow can say; its `start` is the scene's.
  /// \throws SceneError for a scene that cannot be computed.
  SceneSimulation(const Scene& scene, const coupling::Flow& flow);

  const Scene& scene() const { return scene_; }  ///< the scene, with the time step of set_time_step()

  /// Takes steps of that length from now on: time.step of scene() becomes dt. For equal steps.
  /// \throws std::invalid_argument when it is not positive and finite, or steps are adaptive.
  void set_time_step(double dt);

 private:
  SceneSimulation(const Scene& scene, const coupling::Flow& flow, FlowType type);

  Scene scene_;
};

}  // namespace vesiflow::run
