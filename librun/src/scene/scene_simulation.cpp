// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene_simulation.h"

#include "scene/scene_check.h"
#include "scene/scene_mistakes.h"

namespace vesiflow::run {
namespace {

constexpr const char* unnamed_scene = "scene";  // in messages

Scene with_flow(Scene scene, FlowType type) {
  scene.flow.type = type;
  return scene;
}

coupling::Flow started(coupling::Flow flow, const Scene& scene) {
  flow.start = scene.flow.start;
  return flow;
}

// The parameters are checked by the simulation. Where a scene has other mistakes too, all are said together.
const Scene& with_checked_keys(const Scene& scene, const coupling::Flow& flow) {
  if (!mistakes_of_scene_keys(scene).empty()) check_scene(scene, flow, unnamed_scene);
  return scene;
}

}  // namespace

SceneSimulation::SceneSimulation(const Scene& scene) : SceneSimulation(scene, flow_to_check(scene), scene.flow.type) {}

SceneSimulation::SceneSimulation(const Scene& scene, const fluid::BoundaryVelocity& flow, fluid::WallMotion motion)
    : SceneSimulation(scene, coupling::custom_flow(flow, motion)) {}

SceneSimulation::SceneSimulation(const Scene& scene, const coupling::Flow& flow)
    : SceneSimulation(scene, started(flow, scene), FlowType::custom) {}

SceneSimulation::SceneSimulation(const Scene& scene, const coupling::Flow& flow, FlowType type) try : coupling
  ::Simulation(with_checked_keys(scene, flow), flow), scene_(with_flow(scene, type)) {}
catch (const coupling::ParameterError& error) {
  coupling::Mistakes mistakes;
  add_by_key(error, scene, mistakes);
  refuse_scene(mistakes, unnamed_scene);
}

void SceneSimulation::set_time_step(double dt) {
  coupling::Simulation::set_time_step(dt);
  scene_.time.step = dt;
}

}  // namespace vesiflow::run
