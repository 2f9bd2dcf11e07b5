// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/simulation.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::shape_following_test {
namespace {

constexpr double stiff = 60000;  // g in the thousands for time.step = 1/24

Scene following(double sigma0, const Overrides& more = {}) {
  Overrides overrides{"time.markers=shape_following", "time.step=1/24"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scene scene = small_scene(overrides);
  scene.membrane.sigma0 = sigma0;
  return scene;
}

vesicle::Diagnostics at_end(const Scene& scene) {
  SceneSimulation simulation(scene);
  while (!simulation.finished()) simulation.step();
  return simulation.measure().at(0);
}

// Without inertia, whose layers of a thickness of 1e-3 no step resolves, and with a tension soft enough for its own to be resolved:
// the ratio of the differences tends to 4 (6.4 is seen at these steps). If volume and area are corrected after the implicit step
// only, it is 2 and the angle is off by 3e-3 at dt = 1/48.
TEST(ShapeFollowing, IsOfSecondOrder) {
  const auto kept = [](int steps) {
    return at_end(following(1, {"fluid.inertia=none", "time.step=1/" + std::to_string(steps)}));
  };
  const auto a = kept(12), b = kept(24), c = kept(48);
  EXPECT_LT(std::abs(c.inclination_angle - b.inclination_angle),
            0.3 * std::abs(b.inclination_angle - a.inclination_angle));
  EXPECT_LT(std::abs(c.inclination_angle - b.inclination_angle), 1e-4);
  // Nothing but bending and the volume.
  const auto free = [](int steps) {
    return at_end(following(0, {"fluid.inertia=none", "time.step=1/" + std::to_string(steps)}));
  };
  const auto d = free(12), e = free(24), f = free(48);
  EXPECT_NEAR((d.semi_axes[1] - e.semi_axes[1]) / (e.semi_axes[1] - f.semi_axes[1]), 4,
              0.9);  // an order of 1.6 to 2.3: the pairs of steps are not yet in the limit (4.4 is seen)
}

// The mesh stands still there, and with it all that an error could come from.
TEST(ShapeFollowing, SteadyStatesDoNotDependOnTheStep) {
  const auto coarse = at_end(following(stiff, {"time.step=1/12", "time.end=10"}));
  const auto fine = at_end(following(stiff, {"time.step=1/24", "time.end=10"}));
  EXPECT_NEAR(coarse.inclination_angle, fine.inclination_angle, 3e-4 * std::numbers::pi);
  EXPECT_NEAR(coarse.semi_axes[1], fine.semi_axes[1], 1e-3);
}

// A bump of degree 12, of which neither the grid (24^3 resolves 8 degrees) nor the motion knows, must not stand in space for good.
TEST(ShapeFollowing, StartsWithTheDegreesThatItKeeps) {
  Scene scene = following(stiff);
  scene.vesicles[0].shape = Shape::harmonics;
  scene.vesicles[0].reduced_volume.reset();
  scene.vesicles[0].harmonics = {{2, 0, 0.3}, {12, 3, 0.02}};
  SceneSimulation simulation(scene);
  const auto rough = [&] { return simulation.membrane(0).surface().position_coefficients().energy(11, 14); };
  const double before = rough();
  EXPECT_GT(before, 1e-5);
  simulation.step();
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_LT(rough(), 1e-20);
  EXPECT_LT(std::abs(d.volume_error), 1e-12);
  EXPECT_LT(std::abs(d.area_error), 1e-12);
}

// membrane.area = "projection" holds without tension too.
TEST(ShapeFollowing, KeepsTheAreaWithoutTensionWhereAsked) {
  SceneSimulation simulation(following(0, {"membrane.area=projection", "time.step=1/48", "time.end=0.25"}));
  while (!simulation.finished()) simulation.step();
  EXPECT_LT(std::abs(simulation.measure().at(0).area_error), 1e-12);
}

TEST(ShapeFollowing, KeepsAreaAndVolumeToRoundOffAndStrainsSmall) {
  SceneSimulation simulation(following(stiff));
  while (!simulation.finished()) {
    simulation.step();
    const vesicle::Diagnostics d = simulation.measure().at(0);
    EXPECT_LT(std::abs(d.area_error), 1e-12);
    EXPECT_LT(std::abs(d.volume_error), 1e-12);
    EXPECT_LT(d.max_local_area_error, 1e-3);  // the tension, about 10, over sigma0: 2e-4
  }
}

TEST(ShapeFollowing, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const auto positions_with = [](int threads) {
    omp_set_num_threads(threads);
    SceneSimulation simulation(following(stiff, {"fluid.viscosity_ratio=5"}));
    for (int i = 0; i < 6; ++i) simulation.step();
    return vesicle::VectorField(simulation.membrane(0).positions());
  };
  const vesicle::VectorField one = positions_with(1), two = positions_with(2), three = positions_with(3);
  omp_set_num_threads(before);
  EXPECT_TRUE((one == two).all());
  EXPECT_TRUE((one == three).all());
}

void expect_same(SceneSimulation& a, SceneSimulation& b) {
  const SimulationState x = a.state(), y = b.state();
  for (std::size_t i = 0; i < x.vesicles.size(); ++i) {
    EXPECT_TRUE((x.vesicles[i].membrane.positions == y.vesicles[i].membrane.positions).all());
    EXPECT_TRUE((x.vesicles[i].membrane.target_areas == y.vesicles[i].membrane.target_areas).all());
    EXPECT_EQ(x.vesicles[i].motion_history, y.vesicles[i].motion_history);
  }
  EXPECT_TRUE(std::equal(x.velocity.x.data(), x.velocity.x.data() + x.velocity.x.size(), y.velocity.x.data()));
}

// Also when the state is handed on once more before any step: then the history was lost.
TEST(ShapeFollowing, ARestoredRunGoesOnBitForBit) {
  for (const Overrides& overrides :
       {Overrides{}, {"mesh.max_aspect_ratio=1"}, {"fluid.viscosity_ratio=5"}, {"vesicles.0.reduced_volume=0.9999"}}) {
    const Scene scene = following(6000, overrides);
    SceneSimulation whole(scene), restored(scene), again(scene);
    for (int i = 0; i < 14; ++i) whole.step();
    restored.restore(whole.state());
    again.restore(restored.state());
    for (int i = 0; i < 6; ++i)
      for (Simulation* s : {&whole, &restored, &again}) s->step();
    expect_same(whole, restored);
    expect_same(whole, again);
  }
}

TEST(ShapeFollowing, LookingAtItDoesNotChangeIt) {
  SceneSimulation watched(following(stiff)), alone(following(stiff));
  for (int i = 0; i < 4; ++i) {
    watched.step();
    watched.measure();
    alone.step();
  }
  expect_same(watched, alone);
}

// Once the start is over and each part has been used.
TEST(ShapeFollowing, WarmedUpStepsAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  for (const Overrides& overrides : {Overrides{}, {"fluid.viscosity_ratio=5"}, {"vesicles.0.reduced_volume=0.9999"}}) {
    Scene scene = following(6000, overrides);
    scene.mesh.redistribute = Redistribute::never;
    SceneSimulation simulation(scene);
    for (int i = 0; i < 4; ++i) simulation.step();
    const long before = test::allocation_count();
    for (int i = 0; i < 2; ++i) simulation.step();
    EXPECT_EQ(test::allocation_count() - before, 0) << (overrides.empty() ? "" : overrides[0]);
  }
}

TEST(ShapeFollowing, ASphereTurnsAtHalfTheShearRate) {
  Scene scene = following(stiff);
  scene.vesicles[0] = VesicleParameters{};
  scene.vesicles[0].shape = Shape::sphere;
  const vesicle::Diagnostics d = at_end(scene);
  EXPECT_NEAR(d.tank_treading_frequency, 0.5, 0.01);  // walls and the thickened membrane, as for other markers
  EXPECT_LT(std::abs(d.volume_error), 1e-12);
  EXPECT_GT(d.reduced_volume, 0.99);  // as for other markers: only the tension holds the area of a sphere
}

TEST(ShapeFollowing, IsStableWithViscosityContrastAndInertia) {
  for (const Overrides& overrides : {Overrides{"fluid.viscosity_ratio=5", "time.step=1/48", "time.end=2"},
                                     {"fluid.reynolds_number=1", "time.end=2"}}) {
    const vesicle::Diagnostics d = at_end(following(stiff, overrides));
    EXPECT_LT(d.max_local_area_error, 5e-3) << overrides[0];
    EXPECT_LT(std::abs(d.area_error), 1e-12);
  }
}

// The estimate of the stiffness is that of the kernel in use: taken for another one it was up to twice as thick or thin.
TEST(ShapeFollowing, IsQuietWithEveryKernel) {
  for (const DeltaKernel kernel : delta_kernels) {
    const vesicle::Diagnostics d =
        at_end(following(stiff, {"coupling.kernel=" + std::string(name(kernel)), "time.end=1"}));
    EXPECT_LT(d.surface_divergence_max, 0.1) << name(kernel);
    EXPECT_LT(std::abs(d.area_error), 1e-12) << name(kernel);
  }
}

// A fluid twenty times thinner inside: 0.27 is seen where it is told of half of what its explicit viscous term lacks.
TEST(ShapeFollowing, IsQuietAroundAThinFluid) {
  const vesicle::Diagnostics d = at_end(following(
      2000, {"fluid.viscosity_ratio=0.05", "vesicles.0.reduced_volume=0.9", "vesicles.0.rotation_deg=0",
             "mesh.latitudes=24", "domain.cells=[32, 16, 32]", "domain.lower=[-3, 0, -3]", "domain.upper=[3, 3, 3]",
             "domain.mirror=[false, true, false]", "time.step=1/48", "time.end=2"}));
  EXPECT_LT(d.surface_divergence_max, 0.1);  // 0.02 is seen
}

// g = 83. What the fluid remembers of the corrections decides here: paid for as if its answer within the sheet were the one that Z
// is made of, 0.6 is seen, and at larger g the run stops.
TEST(ShapeFollowing, IsQuietAtAReynoldsNumberOfTen) {
  const vesicle::Diagnostics d =
      at_end(following(4000, {"fluid.reynolds_number=10", "mesh.latitudes=20", "vesicles.0.reduced_volume=0.9",
                              "vesicles.0.rotation_deg=0", "time.step=1/48", "time.end=6"}));
  EXPECT_LT(d.surface_divergence_max, 0.05);  // 0.007 is seen
}

// An ellipsoid of reduced volume 0.7 across the flow becomes rounder and long again in another direction. A mesh that follows the normal
// velocity alone is pressed together to a fourth in places, and the run stops at t = 0.3.
TEST(ShapeFollowing, KeepsAGoodMeshOfAShapeThatChanges) {
  const Scene scene =
      following(2000, {"membrane.capillary_number=0.2", "vesicles.0.reduced_volume=0.7", "vesicles.0.rotation_deg=0",
                       "mesh.latitudes=32", "mesh.redistribute=never", "domain.cells=[40, 20, 40]",
                       "domain.lower=[-4, 0, -4]", "domain.upper=[4, 4, 4]", "domain.mirror=[false, true, false]",
                       "time.end=2", "fluid.reynolds_number=1e-3"});
  SceneSimulation simulation(scene);
  while (!simulation.finished()) simulation.step();
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_LT(d.surface_divergence_max, 0.1);
}

// The tips of reduced volume 0.65 answer twice as fast as a plane sheet: with 1.5 times the rates of the sheet the run stops at t = 0.4.
TEST(ShapeFollowing, IsStableAtTipsWithTheCorrectionOfTheThickness) {
  const Scene scene = following(
      2000, {"coupling.thickness_correction=true", "vesicles.0.reduced_volume=0.65", "vesicles.0.rotation_deg=0",
             "mesh.latitudes=72", "domain.cells=[80, 40, 80]", "domain.lower=[-4, 0, -4]", "domain.upper=[4, 4, 4]",
             "domain.mirror=[false, true, false]", "time.end=0.75"});
  const vesicle::Diagnostics d = at_end(scene);
  EXPECT_LT(d.surface_divergence_max, 0.6);  // 0.44 is seen, what is left of a start without tension
  EXPECT_LT(d.max_local_area_error, 1e-2);   // 5e-3 is seen, sigma/sigma0 of the tips
}

// The rim of an ellipsoid 3:3:1: a fluid that is told of all that a plane membrane would owe it is unstable here and
// the run stops.
TEST(ShapeFollowing, OwesAFluidWithInertiaLessAtARim) {
  const Scene scene = following(
      2000, {"flow.type=rest", "fluid.reynolds_number=1", "time.step=1/48", "time.end=0.3", "mesh.latitudes=32",
             "domain.cells=[48, 48, 24]", "domain.lower=[-3, -3, 0]", "domain.mirror=[false, false, true]",
             "vesicles.0.shape=oblate", "vesicles.0.reduced_volume=0.71", "vesicles.0.rotation_deg=0"});
  SceneSimulation simulation(scene);
  while (!simulation.finished()) simulation.step();
  EXPECT_LT(simulation.velocity_noise(0), 0.02);
}

TEST(ShapeFollowing, RelaxationAtRestLosesEnergyAndStaysInPlace) {
  for (const double sigma0 : {0.0, stiff}) {
    Scene scene = following(sigma0, {"flow.type=rest", "time.end=2"});
    SceneSimulation simulation(scene);
    double last = INFINITY;
    while (!simulation.finished()) {
      simulation.step();
      const vesicle::Diagnostics d = simulation.measure().at(0);
      EXPECT_LE(d.bending_energy, last + 1e-9) << simulation.time();
      EXPECT_LT(std::abs(d.volume_error), 1e-12);
      EXPECT_LT(d.centroid.norm(), 1e-10);
      last = d.bending_energy;
    }
    EXPECT_NEAR(simulation.measure()[0].inclination_angle, std::numbers::pi / 6, 1e-2);
  }
}

// Turned by 180 degrees about z the shear is the opposite one, and the vesicle its mirror image in x.
TEST(ShapeFollowing, AMirroredSceneGivesTheMirroredAnswer) {
  const auto forward = at_end(following(stiff));
  const auto mirrored = at_end(following(stiff, {"flow.rate=-1", "vesicles.0.rotation_deg=-60"}));
  EXPECT_NEAR(forward.inclination_angle, -mirrored.inclination_angle, 1e-9);
  EXPECT_NEAR(forward.semi_axes[1], mirrored.semi_axes[1], 1e-9);
}

TEST(ShapeFollowing, AdaptiveStepsAreLongerThanEulers) {
  const Overrides adaptive{"time.adaptive=true", "time.tolerance=2e-5", "time.step=1/192"};
  Overrides euler = adaptive;
  euler.emplace_back("time.markers=euler");
  SceneSimulation shape(following(600, adaptive)), material(following(600, euler));
  for (Simulation* s : {&shape, &material})
    while (!s->finished()) s->step();
  EXPECT_LT(2 * shape.steps(), material.steps());
  EXPECT_LT(std::abs(shape.measure()[0].area_error), 1e-12);
}

}  // namespace
}  // namespace vesiflow::coupling::shape_following_test
