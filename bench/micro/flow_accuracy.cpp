// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Errors in space of the time step in the forced flow of the tests, against its closed form: a table, or JSON.
//   OMP_WAIT_POLICY=passive build/release/bench/flow_accuracy [--cells N...] [--json]
#include <cmath>
#include <cstdio>
#include <vector>

#include <CLI/CLI.hpp>

#include "manufactured_flow.h"

namespace {

using namespace vesiflow::fluid;

struct Case {
  double reynolds_number, dt;
  int steps;
};

// Steady flows: after these steps the errors are of the differences in space alone (see manufactured_order_test.cpp).
const Case cases[] = {{1e-3, 0.01, 10}, {1.0, 0.05, 20}, {10.0, 0.1, 40}};

test::FlowErrors errors(const test::ManufacturedFlow& flow, const Case& c, int cells) {
  const Grid grid({-3, -3, -3}, {3, 3, 3}, {cells, cells, cells});
  FluidParameters parameters;
  parameters.reynolds_number = flow.reynolds_number;
  if (flow.ratio != 1.0) {
    parameters.viscosity = sample_viscosity(grid, [&](const Vector3& r) { return flow.viscosity(r); });
  }
  NavierStokes fluid(grid, parameters, [&](const Vector3& r, double t) { return flow.velocity(r, t); });
  FaceVector exact(grid);
  test::sample_faces(exact, [&](const Vector3& r) { return flow.velocity(r, 0.0); });
  const auto pressure = test::sample_pressure(grid, [&](const Vector3& r) { return flow.pressure(r, 0.0); });
  fluid.restore(exact, exact, pressure, {0.0, -c.dt, c.dt, 1});
  test::sample_faces(fluid.force(), [&](const Vector3& r) { return flow.force(r, 0.0); });
  for (int n = 0; n < c.steps; ++n) fluid.step(c.dt);
  return test::flow_errors(fluid.velocity(), fluid.pressure(), flow, fluid.time());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{16, 24, 32, 48, 64};
  bool json = false;
  CLI::App app{"Errors of a forced flow with the viscosity of a ball, by number of cells."};
  app.add_option("--cells", sizes, "numbers of cells along each edge")
      ->check(CLI::Range(4, 256))
      ->capture_default_str();
  app.add_flag("--json", json, "a list of objects");
  CLI11_PARSE(app, argc, argv);

  const char* separator = "[";
  if (!json) std::printf("%8s %6s %6s %12s %12s %12s\n", "Re", "ratio", "cells", "velocity L2", "max", "pressure L2");
  for (const double ratio : {1.0, 20.0}) {
    for (const Case& c : cases) {
      const test::ManufacturedFlow flow{c.reynolds_number, ratio, 1.0, true};
      for (const int cells : sizes) {
        const test::FlowErrors e = errors(flow, c, cells);
        if (json) {
          std::printf(
              "%s{\"reynolds_number\": %g, \"ratio\": %g, \"cells\": %d, \"velocity_l2\": %.6e, "
              "\"velocity_max\": %.6e, \"pressure_l2\": %.6e}",
              separator, c.reynolds_number, ratio, cells, e.velocity_l2, e.velocity_max, e.pressure_l2);
          separator = ",\n ";
        } else {
          std::printf("%8g %6g %6d %12.3e %12.3e %12.3e\n", c.reynolds_number, ratio, cells, e.velocity_l2,
                      e.velocity_max, e.pressure_l2);
        }
        std::fflush(stdout);
      }
    }
  }
  if (json) std::printf("]\n");
}
