// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene_simulation.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "run/errors.h"
#include "support/small_scene.h"

namespace vesiflow::run::scene_simulation_test {
namespace {

// Of a scene that a program has filled in; with the scene's own flow, or with another one.
template <class... Flow>
std::string refusal_of(const Scene& scene, const Flow&... flow) {
  try {
    const SceneSimulation simulation(scene, flow...);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneSimulation, SaysWrongParametersByTheKeysOfTheScene) {
  Scene scene = coupling::small_scene();
  EXPECT_EQ(refusal_of(scene), "accepted");
  scene.time.step = -0.01;
  EXPECT_EQ(refusal_of(scene), "scene: time.step = -0.01: must be > 0");
  EXPECT_EQ(refusal_of(scene, coupling::flow_at_rest()), "scene: time.step = -0.01: must be > 0");

  Scene from_file = coupling::small_scene();
  from_file.vesicles[0].shape = coupling::Shape::coefficients;
  from_file.vesicles[0].reduced_volume.reset();
  from_file.vesicles[0].surface.emplace(4, 3);
  from_file.vesicles[0].surface->set_zero();  // a point
  EXPECT_TRUE(refusal_of(from_file).starts_with("scene: vesicles.0.surface: ")) << refusal_of(from_file);
  from_file.surface_files[0].file = "point.txt";
  EXPECT_TRUE(refusal_of(from_file).starts_with("scene: vesicles.0.file: ")) << refusal_of(from_file);
}

// What only scenes have is checked here, the parameters by the simulation: a user sees no difference.
TEST(SceneSimulation, SaysAllMistakesTogether) {
  Scene scene = coupling::small_scene();
  scene.output.fluid_every = -1.0;
  EXPECT_EQ(refusal_of(scene), "scene: output.fluid_every = -1: must be >= 0");
  scene.time.step = -0.01;
  scene.mesh.latitudes = 7;
  EXPECT_EQ(refusal_of(scene),
            "3 mistakes:\n"
            "  1. scene: output.fluid_every = -1: must be >= 0\n"
            "  2. scene: mesh.latitudes = 7: must be in [8, 256]\n"
            "  3. scene: time.step = -0.01: must be > 0");
}

// The flow is made of the box before the box is checked: that of a duct needs one with a volume.
TEST(SceneSimulation, RefusesABoxWithoutAVolumeWhateverTheFlow) {
  for (const FlowType type : {FlowType::rest, FlowType::shear, FlowType::plane_poiseuille, FlowType::duct}) {
    Scene scene = coupling::small_scene();
    scene.flow.type = type;
    scene.domain.upper[1] = scene.domain.lower[1];
    EXPECT_EQ(refusal_of(scene), "scene: domain.upper[1] = -3: must be above domain.lower[1] = -3");
    scene.domain.upper[1] = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal_of(scene).find("scene: domain.upper = [3, inf, 3]: each must be a finite number"),
              std::string::npos)
        << refusal_of(scene);
  }
}

TEST(SceneSimulation, NeedsAFlowOfTheProgramWhereTheSceneHasNone) {
  Scene scene = coupling::small_scene();
  scene.flow.type = FlowType::custom;
  EXPECT_NE(refusal_of(scene).find("flow.type = \"custom\""), std::string::npos) << refusal_of(scene);
  EXPECT_EQ(refusal_of(scene, coupling::flow_at_rest()), "accepted");
}

}  // namespace
}  // namespace vesiflow::run::scene_simulation_test
