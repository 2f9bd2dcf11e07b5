// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/simulation.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "coupling/errors.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::simulation_test {
namespace {

VesicleParameters sphere_at(const std::array<double, 3>& centre) {
  VesicleParameters vesicle;
  vesicle.shape = Shape::sphere;
  vesicle.centre = centre;
  return vesicle;
}

void advance(SceneSimulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) simulation.step();
}

// [-3,3]^3, 32^3 cells, 32 latitudes, reduced volume 0.9, started across the flow: 0.1690 pi at t = 2, measured
// with an independent prototype of the same method.
TEST(Simulation, TankTreadingVesicleReachesTheKnownAngle) {
  const Scene scene = small_scene({"domain.cells=32", "mesh.latitudes=32", "time.step=1/192", "time.end=2",
                                   "vesicles.0.reduced_volume=0.9", "vesicles.0.rotation_deg=0"});
  SceneSimulation simulation(scene);
  advance(simulation, scene.steps());
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_GT(d.inclination_angle, 0.1685 * std::numbers::pi);
  EXPECT_LT(d.inclination_angle, 0.1705 * std::numbers::pi);
  EXPECT_LT(std::abs(d.volume_error), 1e-4);
  EXPECT_LT(d.max_local_area_error, 0.05);
  EXPECT_LT(simulation.max_divergence(), 1e-12);
}

TEST(Simulation, SphereInShearKeepsItsShapeAndTurnsAtHalfTheShearRate) {
  Scene scene = small_scene({"time.step=1/960", "time.end=0.4"});  // so sigma0 = 4000: a penalty tension yields
  scene.vesicles[0] = sphere_at({0, 0, 0});
  SceneSimulation simulation(scene);
  advance(simulation, scene.steps());
  const vesicle::Diagnostics d = simulation.measure().at(0);
  // The nearest walls, at three radii, and the thickened membrane speed the surface up or down by a per cent or two.
  EXPECT_NEAR(d.tank_treading_frequency, 0.5, 0.01);
  EXPECT_GT(d.reduced_volume, 0.99);  // the area strain is about 1.5e-2 (600/sigma0)^(2/3) = 4e-3
}

// Nothing acts on a sphere at rest but the constant bending pressure, which a closed surface cannot follow.
TEST(Simulation, SphereAtRestStaysWhereItIs) {
  Scene scene = small_scene({"flow.type=rest"});
  scene.vesicles[0] = sphere_at({0.1, -0.2, 0.3});
  SceneSimulation simulation(scene);
  advance(simulation, 20);
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_NEAR(d.centroid.x(), 0.1, 1e-6);
  EXPECT_NEAR(d.centroid.y(), -0.2, 1e-6);
  EXPECT_NEAR(d.centroid.z(), 0.3, 1e-6);
  EXPECT_NEAR(d.reduced_volume, 1.0, 1e-6);
}

// Shear is odd: the vesicle turned by 180 degrees about y is the same vesicle, mirrored through its centre.
TEST(Simulation, KeepsThePointSymmetryOfTheScene) {
  SceneSimulation simulation(small_scene());
  advance(simulation, 30);
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_LT(d.centroid.norm(), 1e-10);
}

TEST(Simulation, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const auto positions_with = [](int threads) {
    omp_set_num_threads(threads);
    SceneSimulation simulation(small_scene());
    advance(simulation, 12);
    return vesicle::VectorField(simulation.membrane(0).positions());
  };
  const vesicle::VectorField one = positions_with(1), two = positions_with(2), three = positions_with(3);
  omp_set_num_threads(before);
  EXPECT_TRUE((one == two).all());
  EXPECT_TRUE((one == three).all());
}

TEST(Simulation, LookingAtItDoesNotChangeIt) {
  SceneSimulation watched(small_scene()), alone(small_scene());
  for (int i = 0; i < 6; ++i) {
    watched.step();
    watched.measure();
    alone.step();
  }
  EXPECT_TRUE((watched.membrane(0).positions() == alone.membrane(0).positions()).all());
}

// Where its markers sit is no business of the membrane: the motion hardly notices that they are moved along it.
TEST(Simulation, RedistributionLeavesTheMotionAlone) {
  SceneSimulation kept(small_scene({"mesh.redistribute=never"})), moved(small_scene({"mesh.max_aspect_ratio=1"}));
  advance(kept, 48);
  advance(moved, 48);
  EXPECT_EQ(kept.redistributions(0), 0);
  EXPECT_EQ(moved.redistributions(0), 3);
  ASSERT_EQ(moved.last_redistributions().size(), 1U);
  EXPECT_LT(moved.last_redistributions()[0].report.energy_after, moved.last_redistributions()[0].report.energy_before);
  const vesicle::Diagnostics a = kept.measure().at(0), b = moved.measure().at(0);
  EXPECT_NEAR(a.inclination_angle, b.inclination_angle, 1e-3);
  EXPECT_NEAR(a.tank_treading_frequency, b.tank_treading_frequency, 1e-3);
  EXPECT_NEAR(a.area_error, b.area_error, 1e-4);
  EXPECT_NEAR(a.max_local_area_error, b.max_local_area_error, 2e-3);
  moved.step();
  EXPECT_TRUE(moved.last_redistributions().empty());
}

TEST(Simulation, AGoodMeshIsLeftAlone) {
  SceneSimulation simulation(small_scene());
  advance(simulation, 48);
  EXPECT_EQ(simulation.redistributions(0), 0);
}

TEST(Simulation, VesiclesInOneBoxDoNotDependOnTheirOrder) {
  Scene scene = small_scene({"domain.upper=[6, 3, 3]", "domain.cells=[36, 24, 24]"});
  VesicleParameters oblate = sphere_at({2.8, 0, 0.3});
  oblate.shape = Shape::oblate;
  oblate.reduced_volume = 0.95;
  scene.vesicles.push_back(oblate);
  Scene swapped = scene;
  std::swap(swapped.vesicles[0], swapped.vesicles[1]);
  SceneSimulation a(scene), b(swapped);
  advance(a, 10);
  advance(b, 10);
  const auto difference = [&](std::size_t i) {
    return (a.membrane(i).positions() - b.membrane(1 - i).positions()).abs().maxCoeff();
  };
  EXPECT_LT(difference(0), 1e-12);
  EXPECT_LT(difference(1), 1e-12);
}

TEST(Simulation, AWarmedUpStepAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for (const char* markers : {"euler", "ab2", "shape_following"}) {
    SceneSimulation simulation(small_scene({"membrane.g=2", std::string("time.markers=") + markers}));
    advance(simulation, 3);
    const long before = test::allocation_count();
    advance(simulation, 2);
    EXPECT_EQ(test::allocation_count() - before, 0) << markers;
  }
}

// A membrane that nothing holds moves with the fluid: a linear flow carries it exactly.
TEST(Simulation, PassiveMembraneFollowsALinearFlowOfOnesOwn) {
  Scene scene = small_scene({"membrane.capillary_number=1e12", "time.step=0.002", "time.end=0.1",
                             "membrane.volume=none", "mesh.tangential_degrees=16"});
  scene.membrane.sigma0 = 0.0;
  const auto extension = [](const fluid::Vector3& x, double) { return fluid::Vector3{x[0], -0.5 * x[1], -0.5 * x[2]}; };
  SceneSimulation simulation(scene, extension, fluid::WallMotion::steady);
  const vesicle::VectorField start = simulation.membrane(0).positions();
  advance(simulation, 50);
  const double growth = std::pow(1.002, 50), decay = std::pow(1.0 - 0.001, 50);
  const vesicle::VectorField& end = simulation.membrane(0).positions();
  EXPECT_LT((end.col(0) - growth * start.col(0)).abs().maxCoeff(), 1e-4);
  EXPECT_LT((end.col(1) - decay * start.col(1)).abs().maxCoeff(), 1e-4);
}

TEST(Simulation, StopsWithAdviceWhenTheTensionIsUnstable) {
  SceneSimulation simulation(small_scene({"membrane.g=15.5", "time.end=20"}));
  try {
    advance(simulation, 1500);
    FAIL() << "g = 15.5 should not be stable";
  } catch (const SimulationStopped& reason) {
    EXPECT_NE(reason.advice().find("g = 15.5"), std::string::npos);
  }
}

}  // namespace
}  // namespace vesiflow::coupling::simulation_test
