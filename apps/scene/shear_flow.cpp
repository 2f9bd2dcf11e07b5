// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vesicles in shear flow u = (rate z, 0, 0): tank-treading, tumbling, a sphere that turns.
#include "run/run.h"
#include "scene_app.h"

namespace {

int shear_flow(int argc, char** argv) {
  return run_scene_app({.name = "shear_flow",
                        .description = "Computes vesicles in shear flow from a scene file.",
                        .flows = {{vesiflow::run::FlowType::shear, "shear"}}},
                       argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return vesiflow::run::exit_code_of(shear_flow, argc, argv);
}
