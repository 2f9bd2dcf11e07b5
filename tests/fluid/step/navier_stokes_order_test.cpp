// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Orders of accuracy in space and time.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "fluid/navier_stokes.h"
#include "test_fields.h"

namespace vesiflow::fluid::navier_stokes_order_test {
namespace {

using std::numbers::pi;

// Ethier & Steinman 1994 (doi:10.1002/fld.1650190502) with a = pi/4, d = pi/2, viscosity 1, density Re: an
// exact force-free solution of the Navier-Stokes equations in which every term is at work. Defined on
// [-1,1]^3 by custom.
struct EthierSteinman {
  double reynolds_number;
  double decay(double t) const { return std::exp(-pi * pi * t / (4 * reynolds_number)); }

  Vector3 velocity(const Vector3& r, double t) const {
    const double a = pi / 4;
    const double d = pi / 2;
    const auto part = [&](double p, double q, double s) {
      return -a * (std::exp(a * p) * std::sin(a * q + d * s) + std::exp(a * s) * std::cos(a * p + d * q)) * decay(t);
    };
    const auto [x, y, z] = r;
    return {part(x, y, z), part(y, z, x), part(z, x, y)};
  }

  double pressure(const Vector3& r, double t) const {
    const double a = pi / 4;
    const double d = pi / 2;
    const auto part = [&](double p, double q, double s) {
      return std::exp(2 * a * p) + 2 * std::sin(a * p + d * q) * std::cos(a * s + d * p) * std::exp(a * (q + s));
    };
    const auto [x, y, z] = r;
    return -0.5 * reynolds_number * a * a * decay(t) * decay(t) * (part(x, y, z) + part(y, z, x) + part(z, x, y));
  }
};

TEST(EthierSteinman, AgreesWithIndependentValues) {
  const EthierSteinman flow{1.0};
  const Vector3 u = flow.velocity({0.3, -0.2, 0.45}, 0.1);
  EXPECT_NEAR(u[0], -1.276962178219201, 1e-14);
  EXPECT_NEAR(u[1], -1.047379704716668, 1e-14);
  EXPECT_NEAR(u[2], -0.2874450135907921, 1e-14);
  EXPECT_NEAR(flow.pressure({0.3, -0.2, 0.45}, 0.1), -1.4051306431464565, 1e-14);
  EXPECT_NEAR(EthierSteinman{10.0}.pressure({-0.7, 0.61, 0.13}, 0.3), -11.872342931449557, 1e-13);
}

struct Errors {
  double velocity_l2, velocity_max, pressure_l2;
};

FaceVector sample(const EthierSteinman& flow, const Grid& grid, double t) {
  FaceVector u(grid);
  const auto fields = u.points();
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(fields[c].extent, [&](int i, int j, int k) {
      fields[c](i, j, k) = flow.velocity(point_position(grid, static_cast<Centring>(c + 1), i, j, k), t)[c];
    });
  }
  return u;
}

// p without its mean.
Field<Cell> sample_pressure(const EthierSteinman& flow, const Grid& grid, double t) {
  Field<Cell> p(grid);
  double sum = 0.0;
  test::for_each_point(p.extent(), [&](int i, int j, int k) {
    p(i, j, k) = flow.pressure(p.position(i, j, k), t);
    sum += p(i, j, k);
  });
  const double mean = sum / static_cast<double>(grid.cell_count());
  test::for_each_point(p.extent(), [&](int i, int j, int k) { p(i, j, k) -= mean; });
  return p;
}

Errors errors(const NavierStokes& fluid, const EthierSteinman& flow) {
  const Grid& grid = fluid.grid();
  FaceVector u = sample(flow, grid, fluid.time());
  Field<Cell> p = sample_pressure(flow, grid, fluid.time());
  Errors result{0.0, test::max_difference(u, fluid.velocity()), 0.0};
  for (int c = 0; c < 3; ++c) {
    const View exact = u.points()[c];
    const ConstView computed = fluid.velocity().points()[c];
    test::for_each_point(exact.extent, [&](int i, int j, int k) { exact(i, j, k) -= computed(i, j, k); });
  }
  test::for_each_point(p.extent(), [&](int i, int j, int k) { p(i, j, k) -= fluid.pressure()(i, j, k); });
  const double volume = grid.cell_volume();
  result.velocity_l2 = std::sqrt(volume * test::dot(u, u));
  result.pressure_l2 = std::sqrt(volume * test::dot(p.points(), p.points()));
  return result;
}

// Starts with exact histories, so that the start adds no error of its own, and steps so small that the error
// of time is a few per cent of the error of space.
Errors run(int cells, double reynolds_number) {
  const EthierSteinman flow{reynolds_number};
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {cells, cells, cells});
  FluidParameters parameters;
  parameters.reynolds_number = reynolds_number;
  NavierStokes fluid(
      grid, parameters, [&](const Vector3& r, double t) { return flow.velocity(r, t); }, WallMotion::unsteady);
  const double dt = 0.0025;
  fluid.restore(sample(flow, grid, 0.0), sample(flow, grid, -dt), sample_pressure(flow, grid, 0.0), {0.0, -dt, dt, 1});
  for (int k = 0; k < 60; ++k) fluid.step(dt);
  return errors(fluid, flow);
}

double slope(double coarse_error, int coarse_cells, double fine_error, int fine_cells) {
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine_cells) / coarse_cells);
}

// The error is C h^2 (1 - c h + ...): the slope comes to 2 from below (1.92 from 16 to 24 cells, 1.98 from 32
// to 48 and 1.99 from 48 to 64 at Re = 1), later at Re = 10, whose layers are thinner. Hence the test that it
// does come closer.
TEST(NavierStokesOrder, IsTwoInSpace) {
  for (const double reynolds_number : {1.0, 10.0}) {
    const Errors coarse = run(16, reynolds_number);
    const Errors middle = run(32, reynolds_number);
    const Errors fine = run(48, reynolds_number);
    const double first = slope(coarse.velocity_l2, 16, middle.velocity_l2, 32);
    const double second = slope(middle.velocity_l2, 32, fine.velocity_l2, 48);
    EXPECT_NEAR(second, 2.0, 0.1);
    EXPECT_LT(std::abs(second - 2.0), 0.8 * std::abs(first - 2.0));
    EXPECT_GT(slope(middle.velocity_max, 32, fine.velocity_max, 48), 1.7);
    EXPECT_GT(slope(middle.pressure_l2, 32, fine.pressure_l2, 48), 1.5);
  }
}

const Grid small_grid({-1, -1, -1}, {1, 1, 1}, {12, 11, 10});

// A flow that starts from rest smoothly, driven by walls and a force, on a fixed grid. Differences between
// step sizes are then errors of time alone.
FaceVector run_from_rest(const FluidParameters& parameters, const std::vector<double>& pattern, int repetitions) {
  const auto ramp = [](double t) { return std::pow(std::sin(0.5 * pi * t), 4); };
  const EthierSteinman shape{1e10};  // a steady velocity field, for the walls
  NavierStokes fluid(
      small_grid, parameters,
      [&](const Vector3& r, double t) {
        Vector3 u = shape.velocity(r, 0.0);
        for (double& component : u) component *= ramp(t);
        return u;
      },
      WallMotion::unsteady);
  for (int n = 0; n < repetitions; ++n) {
    for (const double dt : pattern) {
      // The scheme takes the force of the new time.
      const double strength = 20.0 * ramp(fluid.time() + dt);
      Field<FaceX>& f = fluid.force().x;
      test::for_each_point(f.extent(), [&](int i, int j, int k) {
        const Vector3 r = f.position(i, j, k);
        f(i, j, k) = strength * std::sin(pi * r[1]) * std::cos(2 * r[2]);
      });
      fluid.step(dt);
    }
  }
  EXPECT_NEAR(fluid.time(), 1.0, 1e-12);
  return fluid.velocity().clone();
}

double l2_difference(FaceVector& a, const FaceVector& b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    const View x = a.unknowns()[c];
    const ConstView y = b.unknowns()[c];
    test::for_each_point(x.extent, [&](int i, int j, int k) { sum += std::pow(x(i, j, k) - y(i, j, k), 2); });
  }
  return std::sqrt(sum);
}

double order_in_time(const std::function<FaceVector(int steps)>& run_with, int steps) {
  FaceVector coarse = run_with(steps);
  FaceVector middle = run_with(2 * steps);
  FaceVector fine = run_with(4 * steps);
  return std::log2(l2_difference(coarse, middle) / l2_difference(middle, fine));
}

TEST(NavierStokesOrder, IsTwoInTime) {
  const auto run_with = [](int steps) { return run_from_rest({}, {1.0 / steps}, steps); };
  EXPECT_NEAR(order_in_time(run_with, 64), 2.0, 0.1);  // 1.93 here, and 1.87 with steps twice as large
}

TEST(NavierStokesOrder, IsTwoInTimeWithChangingSteps) {
  const auto run_with = [](int steps) {
    const double dt = 1.0 / steps;
    return run_from_rest({}, {0.6 * dt, 1.2 * dt, 1.4 * dt, 0.8 * dt}, steps / 4);
  };
  EXPECT_NEAR(order_in_time(run_with, 64), 2.0, 0.1);
}

// At Re = 10. At Re = 1 the orders with these steps are 0.86, 2.15 and 1.82, with half of them 1.07, 1.90 and 1.90; at
// Re = 1e-3 1.20, 1.93 and 1.56, then 1.67, 1.98 and 1.92.
TEST(NavierStokesOrder, InTimeWithVariableViscosityDependsOnItsTreatment) {
  FluidParameters parameters;
  parameters.reynolds_number = 10.0;
  parameters.viscosity = sample_viscosity(small_grid, [](const Vector3& r) {
    return 1.0 + 9.5 * (1.0 - std::tanh(4.0 * (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) - 1.0));
  });
  const auto order = [&](ViscousTreatment treatment, int steps) {
    parameters.viscous_treatment = treatment;
    return order_in_time([&](int n) { return run_from_rest(parameters, {1.0 / n}, n); }, steps);
  };
  EXPECT_NEAR(order(ViscousTreatment::explicit_, 64), 0.8, 0.15);  // 0.74, and 0.87 with half the steps: to 1
  EXPECT_NEAR(order(ViscousTreatment::extrapolated, 64), 2.0, 0.1);
  EXPECT_NEAR(order(ViscousTreatment::implicit, 32), 2.0, 0.1);
}

}  // namespace
}  // namespace vesiflow::fluid::navier_stokes_order_test
