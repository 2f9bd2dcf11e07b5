// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What docs/time_integration.md says of the ways to advance membranes.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/errors.h"
#include "coupling/marker_integrator.h"
#include "coupling/simulation.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::time_integration_test {
namespace {

void advance(SceneSimulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) simulation.step();
}

Overrides with(const char* markers, std::initializer_list<const char*> more = {}) {
  Overrides overrides{std::string("time.markers=") + markers};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

// A passive membrane in a steady linear flow: its markers obey dx/dt = x and so on, and arkode solves that to its tolerance,
// where Euler has the error of its order.
TEST(TimeIntegration, ArkodeFollowsALinearFlowToItsTolerance) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  const auto extension = [](const fluid::Vector3& x, double) { return fluid::Vector3{x[0], -0.5 * x[1], -0.5 * x[2]}; };
  const auto error_of = [&](const char* markers) {
    Scene scene =
        small_scene(with(markers, {"membrane.capillary_number=1e12", "time.step=0.05", "time.end=0.1",
                                   "membrane.volume=none", "mesh.tangential_degrees=16", "fluid.inertia=none"}));
    scene.membrane.sigma0 = 0.0;
    SceneSimulation simulation(scene, extension, fluid::WallMotion::steady);
    const vesicle::VectorField start = simulation.membrane(0).positions();
    advance(simulation, 2);
    return (simulation.membrane(0).positions().col(0) - std::exp(0.1) * start.col(0)).abs().maxCoeff();
  };
  EXPECT_GT(error_of("euler"), 1e-3);
  EXPECT_LT(error_of("arkode"), 1e-5);  // a few tolerances
}

// A flow that starts to move at the rate t: x' = t x. Within a step the interpolated velocity is exact, the frozen one is late.
TEST(TimeIntegration, InterpolatedVelocityIsOfSecondOrderInTime) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  const auto growing = [](const fluid::Vector3& x, double t) {
    return fluid::Vector3{t * x[0], -0.5 * t * x[1], -0.5 * t * x[2]};
  };
  const auto error_of = [&](const char* velocity, int steps) {
    Scene scene = small_scene(with("arkode", {"membrane.capillary_number=1e12", "time.end=0.2", "membrane.volume=none",
                                              "mesh.tangential_degrees=16", "time.absolute_tolerance=1e-10",
                                              "fluid.inertia=none", "domain.cells=16"}));
    scene.membrane.sigma0 = 0.0;
    scene.time.step = 0.2 / steps;
    scene.time.fluid_velocity = std::string(velocity) == "frozen" ? FluidVelocity::frozen : FluidVelocity::interpolated;
    SceneSimulation simulation(scene, growing, fluid::WallMotion::unsteady);
    const vesicle::VectorField start = simulation.membrane(0).positions();
    advance(simulation, steps);
    return (simulation.membrane(0).positions().col(0) - std::exp(0.02) * start.col(0)).abs().maxCoeff();
  };
  EXPECT_NEAR(std::log2(error_of("frozen", 2) / error_of("frozen", 4)), 1.0, 0.1);
  EXPECT_LT(error_of("interpolated", 2), 1e-2 * error_of("frozen", 2));
}

TEST(TimeIntegration, ArkodeTakesTheVesicleWhereEulerDoes) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  SceneSimulation euler(small_scene()), arkode(small_scene(with("arkode"))),
      interpolated(small_scene(with("arkode", {"time.fluid_velocity=interpolated"})));
  for (SceneSimulation* s : {&euler, &arkode, &interpolated}) advance(*s, 48);
  const double angle = euler.measure().at(0).inclination_angle;
  EXPECT_NEAR(arkode.measure().at(0).inclination_angle, angle, 5e-3);
  EXPECT_NEAR(interpolated.measure().at(0).inclination_angle, angle, 5e-3);
  EXPECT_EQ(euler.marker_statistics(0).evaluations, 48);
  EXPECT_GE(arkode.marker_statistics(0).sub_steps, 48);
  EXPECT_GE(arkode.marker_statistics(0).evaluations, 3 * 48);
}

// Volume and area that are kept by projection are kept to round-off at the end of every step, at any step length.
TEST(TimeIntegration, ProjectionsAreExactInEveryStep) {
  SceneSimulation volume(small_scene()), both(small_scene({"membrane.area=projection", "flow.type=rest"}));
  for (int k = 0; k < 24; ++k) {
    volume.step();
    both.step();
    EXPECT_LT(std::abs(volume.measure().at(0).volume_error), 1e-12);
    EXPECT_LT(std::abs(both.measure().at(0).volume_error), 1e-12);
    EXPECT_LT(std::abs(both.measure().at(0).area_error), 1e-12);
  }
  EXPECT_GT(std::abs(volume.measure().at(0).area_error), 1e-4);
}

// The elastic tension holds area only by a strain; the integral of the strain takes its place.
TEST(TimeIntegration, IntegralTensionTakesTheSteadyAreaErrorAway) {
  SceneSimulation elastic(small_scene()), integral(small_scene({"membrane.integral_rate=10"}));
  double before = 0.0;
  for (SceneSimulation* s : {&elastic, &integral}) advance(*s, 96);
  before = std::abs(integral.measure().at(0).area_error);
  EXPECT_LT(before, 0.2 * std::abs(elastic.measure().at(0).area_error));
  advance(integral, 48);
  EXPECT_LT(std::abs(integral.measure().at(0).area_error), 0.5 * before);  // still falling
}

// g = 16 is twice what the tension of the strain itself allows, and well below (2 - a)/a = 7 times that.
TEST(TimeIntegration, StrainRelaxationIsStableBeyondTheExplicitLimit) {
  const Overrides large{"membrane.g=16", "time.step=1/24", "time.end=2"};
  Overrides relaxed = with("strain_relaxation");
  relaxed.insert(relaxed.end(), large.begin(), large.end());
  SceneSimulation plain(small_scene(large)), filtered(small_scene(relaxed)), small_steps(small_scene({"membrane.g=4"}));
  EXPECT_THROW(advance(plain, 300), SimulationStopped);
  advance(filtered, 48);
  advance(small_steps, 192);
  const vesicle::Diagnostics d = filtered.measure().at(0), reference = small_steps.measure().at(0);
  EXPECT_LT(d.max_local_area_error, 0.05);
  EXPECT_NEAR(d.inclination_angle, reference.inclination_angle, 0.01);
}

TEST(TimeIntegration, WarmedUpStepsAllocateNothing) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for (const Overrides& overrides : {with("strain_relaxation"), Overrides{"membrane.integral_rate=2"},
                                     Overrides{"membrane.area=projection"}, with("arkode")}) {
    if (overrides[0] == "time.markers=arkode" && !have_sundials()) continue;
    SceneSimulation simulation(small_scene(overrides));
    advance(simulation, 4);
    const long before = vesiflow::test::allocation_count();
    advance(simulation, 2);
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << overrides[0];
  }
}

}  // namespace
}  // namespace vesiflow::coupling::time_integration_test
