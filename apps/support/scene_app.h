#pragma once

#include <optional>
#include <string>

#include "coupling/scene.h"

/// What sets one scene app apart from another.
struct SceneApp {
  std::string name;
  std::string description;
  std::optional<vesiflow::coupling::FlowType> flow;  ///< the flow.type a scene of this app must have, if it must
};

/// The whole program: reads the command line and the scene, prints the plan or runs it. Returns the exit code.
int run_scene_app(const SceneApp& app, int argc, char** argv);
