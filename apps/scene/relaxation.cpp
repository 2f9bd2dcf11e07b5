// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vesicles that relax in fluid at rest.
#include "run/run.h"
#include "scene_app.h"

namespace {

int relaxation(int argc, char** argv) {
  return run_scene_app({.name = "relaxation",
                        .description = "Computes vesicles relaxing in fluid at rest from a scene file.",
                        .flows = {{vesiflow::run::FlowType::rest, "rest"}}},
                       argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return vesiflow::run::exit_code_of(relaxation, argc, argv);
}
