// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vesicles in pressure-driven flow, in a rectangular duct or between two plates: bullets, parachutes, croissants, slippers.
#include "run/run.h"
#include "scene_app.h"

namespace {

using vesiflow::run::FlowType;

int poiseuille(int argc, char** argv) {
  return run_scene_app({.name = "poiseuille",
                        .description = "Computes vesicles in pressure-driven flow from a scene file.",
                        .flows = {{FlowType::duct, "duct"}, {FlowType::plane_poiseuille, "plane_poiseuille"}}},
                       argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return vesiflow::run::exit_code_of(poiseuille, argc, argv);
}
