// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A flow of one's own: a channel, periodic along x and y, whose upper wall moves and which holds a ball of another viscosity.
#include <cmath>
#include <cstdio>
#include <exception>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"

using namespace vesiflow::fluid;

int main() try {
  const Grid grid({0, 0, 0}, {2, 2, 1}, {32, 32, 16}, {.periodic = {true, true, false}});
  const auto wall = [](const Vector3& r, double t) { return Vector3{r[2] > 0.5 ? std::tanh(t) : 0.0, 0.0, 0.0}; };

  FluidParameters parameters;
  parameters.reynolds_number = 10;
  parameters.viscosity = sample_viscosity(grid, [&](const Vector3& r) {
    const double distance = std::hypot(r[0] - 1, r[1] - 1, r[2] - 0.5) - 0.3;
    return 1 + 2 * (1 - std::tanh(distance / grid.spacing(0)));  // 5 inside, 1 outside
  });
  NavierStokes flow(grid, parameters, wall, WallMotion::unsteady);

  std::printf("  time  speed above the ball  divergence\n");
  for (int step = 0; step < 100; ++step) {
    flow.force().x.fill(0.1);  // per volume, for the coming step: a pressure gradient along the channel
    flow.step(0.02);
    if (flow.steps() % 20 != 0) continue;
    const double speed = flow.velocity().x(16, 16, 14);  // face (16, 16, 14) of those normal to x
    std::printf("%6.2f  %20.6f  %10.1e\n", flow.time(), speed, max_divergence(flow.velocity()));
  }
  const Vector3 place = flow.velocity().x.position(16, 16, 14);
  std::printf("at (%g, %g, %g), solved by %s and %s\n", place[0], place[1], place[2],
              flow.velocity_solver_name().c_str(), flow.pressure_solver_name().c_str());
  return max_divergence(flow.velocity()) < 1e-12 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
