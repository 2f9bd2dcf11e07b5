// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene_simulation.h"

#include "scene/scene_check.h"

namespace vesiflow::run {
namespace {

Scene with_flow(Scene scene, FlowType type) {
  scene.flow.type = type;
  return scene;
}

coupling::Flow started(coupling::Flow flow, const Scene& scene) {
  flow.start = scene.flow.start;
  return flow;
}

// Parameters are checked as those of a scene first, so that mistakes are said of its keys.
const Scene& checked(const Scene& scene, const coupling::Flow& flow) {
  check_scene(scene, flow, "scene");
  return scene;
}

}  // namespace

SceneSimulation::SceneSimulation(const Scene& scene) : SceneSimulation(scene, flow_of(scene), scene.flow.type) {}

SceneSimulation::SceneSimulation(const Scene& scene, const fluid::BoundaryVelocity& flow, fluid::WallMotion motion)
    : SceneSimulation(scene, coupling::custom_flow(flow, motion)) {}

SceneSimulation::SceneSimulation(const Scene& scene, const coupling::Flow& flow)
    : SceneSimulation(scene, started(flow, scene), FlowType::custom) {}

SceneSimulation::SceneSimulation(const Scene& scene, const coupling::Flow& flow, FlowType type)
    : coupling::Simulation(checked(scene, flow), flow), scene_(with_flow(scene, type)) {}

void SceneSimulation::set_time_step(double dt) {
  coupling::Simulation::set_time_step(dt);
  scene_.time.step = dt;
}

}  // namespace vesiflow::run
