// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "duct_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fluid/navier_stokes.h"
#include "fluid/stokes.h"

using namespace vesiflow::fluid;

namespace {

constexpr double periodic_time_step = 10;  // over the diffusion time

Grid grid_of(const Duct& duct, const std::array<int, 3>& cells) {
  return {{-0.5 * duct.length, -duct.d, -duct.e},
          {0.5 * duct.length, duct.d, duct.e},
          cells,
          {.periodic = {duct.ends == DuctEnds::periodic, false, false}}};
}

BoundaryVelocity wall_velocity(const Duct& duct, const DuctSeries& series) {
  if (duct.ends == DuctEnds::periodic) return [](const Vector3&, double) { return Vector3{}; };
  return [series](const Vector3& position, double) { return Vector3{series.velocity(position[1], position[2]), 0, 0}; };
}

double driving_force(const Duct& duct, const DuctSeries& series) {
  return duct.ends == DuctEnds::periodic ? series.pressure_gradient() : 0;
}

SteadyRun solve_unsteady(const Duct& duct, const DuctSeries& series, SteadyOptions options, FaceVector& velocity) {
  FluidParameters parameters;
  parameters.reynolds_number = duct.reynolds_number;
  NavierStokes fluid(velocity.grid(), parameters, wall_velocity(duct, series));
  fluid.force().x.fill(driving_force(duct, series));
  options.time_scale = options.largest_time_step = duct.diffusion_time();
  if (duct.ends == DuctEnds::periodic && !options.time_step)
    options.time_step = periodic_time_step * duct.diffusion_time();
  const SteadyRun run = run_to_steady_state(fluid, options);
  velocity = fluid.velocity().clone();
  return run;
}

SteadyRun solve_stokes(const Duct& duct, const DuctSeries& series, const SteadyOptions& options, FaceVector& velocity) {
  const Grid& grid = velocity.grid();
  FaceVector force(grid);
  force.x.fill(driving_force(duct, series));
  Field<Cell> pressure(grid);
  const WallVelocity walls(grid, wall_velocity(duct, series));
  StokesSolver solver(grid, {.tolerance = options.tolerance});
  const StokesReport report = solver.solve(force, walls, velocity, pressure);
  SteadyRun run;
  run.steady = report.converged;
  run.change = report.residual;
  run.steps = report.iterations;
  run.seconds = report.seconds;
  return run;
}

void measure(const DuctSeries& series, DuctFlow& flow) {
  const ConstView u = std::as_const(flow.velocity).unknowns()[0];
  const Field<FaceX>& field = flow.velocity.x;
  double squares = 0;
  for (int k = 0; k < u.extent[2]; ++k)
    for (int j = 0; j < u.extent[1]; ++j) {
      const Vector3 position = field.position(0, j, k);
      const double exact = series.velocity(position[1], position[2]);
      for (int i = 0; i < u.extent[0]; ++i) {
        const double error = std::abs(u(i, j, k) - exact);
        squares += error * error;
        flow.error_max = std::max(flow.error_max, error);
      }
    }
  flow.error_l2 = std::sqrt(squares / (static_cast<double>(u.extent[0]) * u.extent[1] * u.extent[2]));
  for (int component = 1; component < 3; ++component) {
    const ConstView across = std::as_const(flow.velocity).points()[component];
    for (int k = 0; k < across.extent[2]; ++k)
      for (int j = 0; j < across.extent[1]; ++j)
        for (int i = 0; i < across.extent[0]; ++i)
          flow.cross_flow = std::max(flow.cross_flow, std::abs(across(i, j, k)));
  }
}

}  // namespace

double Duct::diffusion_time() const {
  const double ky = std::numbers::pi / (2 * d), kz = std::numbers::pi / (2 * e);
  return reynolds_number / (ky * ky + kz * kz);
}

DuctFlow compute_duct(const Duct& duct, const std::array<int, 3>& cells, DuctMethod method, SteadyOptions options) {
  const DuctSeries series(duct.d, duct.e);
  DuctFlow flow{cells, {}, FaceVector(grid_of(duct, cells)), 0, 0, 0};
  flow.run = method == DuctMethod::stokes ? solve_stokes(duct, series, options, flow.velocity)
                                          : solve_unsteady(duct, series, options, flow.velocity);
  measure(series, flow);
  return flow;
}
