// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "run/scene.h"

/// What sets one scene app apart from another.
struct SceneApp {
  std::string name;
  std::string description;
  struct NamedFlow {
    vesiflow::run::FlowType type;
    std::string name;  ///< as scenes have it
  };
  std::vector<NamedFlow> flows = {};  ///< what flow.type may be; anything if empty
};

/// The whole program: reads the command line and the scene, prints the plan or runs it. Returns the exit code.
int run_scene_app(const SceneApp& app, int argc, char** argv);
