// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Orders of accuracy in a forced flow with constant and with variable viscosity.
#include <gtest/gtest.h>

#include <cstdio>

#include "manufactured_flow.h"

namespace vesiflow::fluid::manufactured_order_test {
namespace {

using test::FlowErrors;
using test::ManufacturedFlow;

// Values of an independent symbolic computation.
TEST(ManufacturedFlow, AgreesWithIndependentValues) {
  const ManufacturedFlow constant{1.0};
  const Vector3 r{0.3, -0.2, 0.45};
  EXPECT_NEAR(constant.velocity(r, 0.1)[0], -0.90014000412836, 1e-14);
  EXPECT_NEAR(constant.velocity(r, 0.1)[2], -1.0280360757665477, 1e-14);
  EXPECT_NEAR(constant.pressure(r, 0.1), -0.037193406833776727, 1e-15);
  EXPECT_NEAR(constant.force(r, 0.1)[0], -1.6706787407576826, 1e-13);
  EXPECT_NEAR(constant.force(r, 0.1)[2], -1.0141827603242528, 1e-13);
  const ManufacturedFlow five{1.0, 5.0};
  EXPECT_NEAR(five.force(r, 0.1)[0], -5.912498699331743, 1e-13);
  EXPECT_NEAR(five.force(r, 0.1)[1], -6.005087499904957, 1e-13);
  const ManufacturedFlow twenty{0.001, 20.0};
  const Vector3 s{-0.6, 0.7, 0.5};
  EXPECT_NEAR(twenty.force(s, 0.25)[0], 0.20956275344083597, 1e-12);
  EXPECT_NEAR(twenty.force(s, 0.25)[1], 11.727672450746473, 1e-12);
  EXPECT_NEAR(twenty.force(s, 0.25)[2], 6.0189862236846166, 1e-12);
}

// Starts from the exact flow, its history included.
NavierStokes start(const ManufacturedFlow& flow, ViscousTreatment treatment, int cells, double dt) {
  const Grid grid({-3, -3, -3}, {3, 3, 3}, {cells, cells, cells});
  FluidParameters parameters;
  parameters.reynolds_number = flow.reynolds_number;
  parameters.viscous_treatment = treatment;
  if (flow.ratio != 1.0) {
    parameters.viscosity = sample_viscosity(grid, [&](const Vector3& r) { return flow.viscosity(r); });
  }
  NavierStokes fluid(
      grid, parameters, [flow](const Vector3& r, double t) { return flow.velocity(r, t); },
      flow.steady ? WallMotion::steady : WallMotion::unsteady);
  FaceVector now(grid), before(grid);
  test::sample_faces(now, [&](const Vector3& r) { return flow.velocity(r, 0.0); });
  test::sample_faces(before, [&](const Vector3& r) { return flow.velocity(r, -dt); });
  fluid.restore(now, before, test::sample_pressure(grid, [&](const Vector3& r) { return flow.pressure(r, 0.0); }),
                {0.0, -dt, dt, 1});
  return fluid;
}

void advance(NavierStokes& fluid, const ManufacturedFlow& flow, double dt, int steps) {
  for (int n = 0; n < steps; ++n) {
    if (n == 0 || !flow.steady) {
      test::sample_faces(fluid.force(), [&](const Vector3& r) { return flow.force(r, fluid.time() + dt); });
    }
    fluid.step(dt);
  }
}

struct Case {
  double reynolds_number, dt;
  int steps;
};

// Of a steady flow: the error, that of the discrete flow growing out of the exact one, is of the differences in space
// alone. At low Reynolds numbers it is there after a few steps; at Re = 10 it is followed for a time in which its layers
// at the walls become thicker than the cells.
const Case cases[] = {{1e-3, 0.01, 10}, {1.0, 0.05, 20}, {10.0, 0.1, 40}};

void expect_second_order_in_space(double ratio, ViscousTreatment treatment, const Case& c, int coarse, int fine) {
  const ManufacturedFlow flow{c.reynolds_number, ratio, 1.0, true};
  const auto errors = [&](int cells) {
    NavierStokes fluid = start(flow, treatment, cells, c.dt);
    advance(fluid, flow, c.dt, c.steps);
    return test::flow_errors(fluid.velocity(), fluid.pressure(), flow, fluid.time());
  };
  const FlowErrors first = errors(coarse);
  const FlowErrors second = errors(fine);
  const double velocity_order = test::slope(first.velocity_l2, coarse, second.velocity_l2, fine);
  const double pressure_order = test::slope(first.pressure_l2, coarse, second.pressure_l2, fine);
  EXPECT_NEAR(velocity_order, 2.0, 0.1) << "Re = " << c.reynolds_number;
  EXPECT_GT(pressure_order, 1.5) << "Re = " << c.reynolds_number;
  // For those who read the log: the orders themselves.
  std::printf("Re %g, ratio %g: velocity %.2e %.2e order %.3f, pressure %.2e %.2e order %.3f\n", c.reynolds_number,
              ratio, first.velocity_l2, second.velocity_l2, velocity_order, first.pressure_l2, second.pressure_l2,
              pressure_order);
}

TEST(NavierStokesOrder, IsTwoInAForcedFlow) {
  for (const Case& c : cases) expect_second_order_in_space(1.0, ViscousTreatment::extrapolated, c, 32, 48);
}

TEST(NavierStokesOrder, IsTwoWithVariableViscosityExtrapolated) {
  for (const Case& c : cases) expect_second_order_in_space(20.0, ViscousTreatment::extrapolated, c, 32, 48);
}

TEST(NavierStokesOrder, IsTwoWithVariableViscosityImplicit) {
  for (const Case& c : cases) expect_second_order_in_space(20.0, ViscousTreatment::implicit, c, 24, 32);
}

}  // namespace
}  // namespace vesiflow::fluid::manufactured_order_test
