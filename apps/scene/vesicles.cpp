// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vesicles in any flow that a scene can name.
#include "run/run.h"
#include "scene_app.h"

namespace {

int vesicles(int argc, char** argv) {
  return run_scene_app({.name = "vesicles", .description = "Computes vesicles in a flow, both from a scene file."},
                       argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return vesiflow::run::exit_code_of(vesicles, argc, argv);
}
