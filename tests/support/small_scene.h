// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "run/scene_simulation.h"

namespace vesiflow::coupling {

// What whole simulations are tested by is written as scenes.
using run::check_scene, run::flow_of, run::FlowType, run::load_scene, run::OnBlowUp, run::Overrides, run::parse_scene,
    run::Preset, run::Scene, run::SceneError, run::SceneSimulation, run::to_toml;

/// A vesicle in shear flow small enough for a test: 24^3 cells of the size of the paper's N = 48, 16 latitudes.
inline Scene small_scene(const Overrides& overrides = {}) {
  return parse_scene(R"(
[domain]
lower = [-3, -3, -3]
upper = [3, 3, 3]
cells = 24
[coupling]
method = "delta"
[membrane]
g = "25/6"
[mesh]
latitudes = 16
[time]
markers = "euler"
step = "1/96"
end = 0.5
[output]
diagnostics_every = 0.1
vesicle_every = 0.25
fluid_every = 0.25
checkpoint_every = 0.25
[[vesicles]]
shape = "prolate"
reduced_volume = 0.95
rotation_deg = 60
)",
                     "small scene", overrides);
}

/// Three vesicles in shear, no two alike, near enough to repel each other.
inline Scene three_vesicles(const Overrides& overrides = {}) {
  return parse_scene(R"(
[domain]
lower = [-3, -3, -3]
upper = [6, 3, 3]
cells = [36, 24, 24]
periodic = [true, true, false]
[coupling]
method = "delta"
[membrane]
g = 3
[mesh]
latitudes = 16
tangential_degrees = 12
[gravity]
acceleration = [0, 0, -1]
[repulsion]
range = 0.4
strength = 20
[time]
markers = "euler"
step = "1/96"
end = 0.5
[output]
diagnostics_every = 0.1
vesicle_every = 0.25
fluid_every = 0
checkpoint_every = 0.25
[[vesicles]]
shape = "prolate"
reduced_volume = 0.95
rotation_deg = 60
density_difference = 2
[[vesicles]]
shape = "oblate"
reduced_volume = 0.9
radius = 0.8
centre = [2.35, 0.2, 0.1]
latitudes = 20
capillary_number = 1.0
spontaneous_curvature = 0.3
[[vesicles]]
shape = "sphere"
radius = 0.7
centre = [4.25, 0, 0.3]
latitudes = 12
sigma0 = 200
density_difference = -3
)",
                     "three vesicles", overrides);
}

}  // namespace vesiflow::coupling
