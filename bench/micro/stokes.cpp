// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// One Stokes solve from zero in a cube with walls: a shear flow around a sphere with forces on it and another viscosity
// inside, across an interface two cells thick. Iterations are a counter; ratio 1 is a number, not a field.
//   OMP_NUM_THREADS=1 build/release/bench/stokes
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "fluid/stokes.h"

namespace {

using namespace vesiflow::fluid;

double radius(const Vector3& x) {
  return std::hypot(x[0], x[1], x[2]);
}

// Of a smoothed delta function of the unit sphere, with components along and across the normal.
FaceVector membrane_force(const Grid& grid) {
  FaceVector force(grid);
  const double width = 2.0 * grid.spacing(0);
  for (int c = 0; c < 3; ++c) {
    const View f = force.points()[c];
    for (int k = 0; k < f.extent[2]; ++k) {
      for (int j = 0; j < f.extent[1]; ++j) {
        for (int i = 0; i < f.extent[0]; ++i) {
          const Vector3 x = point_position(grid, face_centrings[c], i, j, k);
          const double distance = (radius(x) - 1.0) / width;
          if (std::abs(distance) >= 1.0) continue;
          const double delta = 0.5 / width * (1.0 + std::cos(std::numbers::pi * distance));
          f(i, j, k) = delta * (x[c] * (1.0 + x[0] * x[2]) + (c == 0 ? x[1] * x[1] : 0.3 * x[2]));
        }
      }
    }
  }
  return force;
}

void stokes_solve(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const double ratio = static_cast<double>(state.range(1));
  const Grid grid({-2, -2, -2}, {2, 2, 2}, {cells, cells, cells});
  const auto mu = [&](const Vector3& x) {
    return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh((radius(x) - 1.0) / grid.spacing(0)));
  };
  StokesSolver solver(grid);
  solver.update(ratio == 1.0 ? Viscosity(1.0) : Viscosity(sample_viscosity(grid, mu)));
  const FaceVector force = membrane_force(grid);
  const WallVelocity walls(grid, [](const Vector3& x, double) { return Vector3{x[2], 0, 0}; });
  FaceVector u(grid);
  Field<Cell> p(grid);
  StokesReport report;
  for (auto _ : state) {
    u.fill(0.0);
    p.fill(0.0);
    report = solver.solve(force, walls, u, p);
  }
  state.counters["iterations"] = report.iterations;
  state.counters["residual"] = report.residual;
}

BENCHMARK(stokes_solve)
    ->ArgNames({"cells", "ratio"})
    ->ArgsProduct({{16, 32, 48, 64, 96}, {1, 5, 20, 100}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
