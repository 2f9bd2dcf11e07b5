// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A scene and a flow of one's own: a vesicle stretched by uniaxial extension u = rate (-x/2, -y/2, z).
#include <cstdio>

#include "run/run.h"

namespace {

using namespace vesiflow;

run::Scene scene() {
  run::Scene scene;
  scene.title = "A prolate vesicle in extensional flow";
  scene.domain = {.lower = {-3, -3, -3}, .upper = {3, 3, 3}, .cells = {32, 32, 32}};
  scene.mesh.latitudes = 24;
  scene.membrane.sigma0 = 300;
  scene.time.step = 1.0 / 96;
  scene.time.end = 0.25;
  scene.output = {.vesicle_every = 0, .fluid_every = 0, .checkpoint_every = 0};  // needs no HDF5
  scene.vesicles.resize(1);
  scene.vesicles[0].reduced_volume = 0.9;
  run::check_scene(scene, "extension");
  return scene;
}

int extension(int argc, char** argv) {
  constexpr double rate = 0.5;
  const auto flow = [](const fluid::Vector3& x, double) {
    return fluid::Vector3{-rate / 2 * x[0], -rate / 2 * x[1], rate * x[2]};
  };
  run::SceneSimulation simulation(scene(), flow, fluid::WallMotion::steady);
  run::run(simulation, {.program = "extension", .directory = argc > 1 ? argv[1] : "out", .quiet = true});

  const vesicle::Diagnostics end = simulation.measure().front();
  std::printf("t = %g: semi-axes %.4f %.4f %.4f, area error %.1e, volume error %.1e\n", simulation.time(),
              end.semi_axes[0], end.semi_axes[1], end.semi_axes[2], end.area_error, end.volume_error);
  return run::exit_code::success;
}

}  // namespace

int main(int argc, char** argv) {
  return vesiflow::run::exit_code_of(extension, argc, argv);
}
