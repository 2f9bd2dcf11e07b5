// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A simulation without any configuration file: a vesicle in shear flow, with a force of the program's own that keeps it in place.
#include <cstdio>
#include <numbers>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/simulation.h"

using namespace vesiflow;

int main() try {
  coupling::SimulationParameters parameters;
  parameters.domain = {.lower = {-3, -3, -3}, .upper = {3, 3, 3}, .cells = {32, 32, 32}};
  parameters.mesh.latitudes = 24;
  parameters.time.step = 1.0 / 24;
  parameters.time.end = 1.0;
  parameters.vesicles.resize(1);
  parameters.vesicles[0].reduced_volume = 0.9;
  parameters.vesicles[0].rotation_deg = 60;

  coupling::Simulation simulation(parameters, coupling::shear_flow(1.0, parameters.domain));
  simulation.add_force([](double, std::size_t, const vesicle::Surface& membrane, vesicle::VectorField& force) {
    const vesicle::ScalarField& area = membrane.area_weight();
    for (int axis = 0; axis < 3; ++axis) {
      const double centre = (membrane.positions().col(axis) * area).sum() / area.sum();
      force.col(axis) -= 10.0 * centre;
    }
  });
  while (!simulation.finished()) {
    simulation.step();
    const vesicle::Diagnostics now = simulation.measure().front();
    if (simulation.steps() % 6 == 0)
      std::printf("t = %.2f  angle %5.1f degrees  area error %.1e\n", simulation.time(),
                  now.inclination_angle * 180.0 / std::numbers::pi, now.area_error);
  }
  return 0;
} catch (const coupling::ParameterError& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
