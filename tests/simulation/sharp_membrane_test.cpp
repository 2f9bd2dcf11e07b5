// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Simulations with coupling.method = "sharp".
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <string>

#include "coupling/simulation.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::sharp_membrane_test {
namespace {

constexpr const char* equal = "fluid.viscosity_ratio=1";
constexpr const char* five = "fluid.viscosity_ratio=5";

Scene sharp(const Overrides& more = {}) {
  Overrides overrides{"coupling.method=sharp",
                      "time.markers=shape_following",
                      "time.step=1/24",
                      "fluid.inertia=none",
                      "membrane.g=70",
                      "vesicles.0.reduced_volume=0.9",
                      "vesicles.0.rotation_deg=60"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return small_scene(overrides);
}

void advance(SceneSimulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

TEST(SharpMembrane, TankTreadsQuietlyAndKeepsAreaAndVolume) {
  for (const char* ratio : {equal, five}) {
    SceneSimulation simulation(sharp({ratio, "time.end=1.5"}));
    while (!simulation.finished()) {
      simulation.step();
      const vesicle::Diagnostics d = simulation.measure().at(0);
      EXPECT_LT(std::abs(d.area_error), 1e-12);
      EXPECT_LT(std::abs(d.volume_error), 1e-12);
      EXPECT_LT(simulation.max_divergence(), 1e-11);
    }
    const vesicle::Diagnostics d = simulation.measure().at(0);
    EXPECT_LT(d.surface_divergence_max, 0.05) << ratio;
    EXPECT_LT(d.max_local_area_error, 5e-3) << ratio;
    EXPECT_LT(simulation.velocity_noise(0), 0.01 * simulation.membrane_speed(0)) << ratio;
    EXPECT_EQ(simulation.interface_passes() > 0, ratio == five);
  }
}

// Before any step the fluid has not felt the membrane, and what is said of its velocity is the flow.
TEST(SharpMembrane, BeginsInTheUndisturbedFlow) {
  for (const char* ratio : {equal, five}) {
    SceneSimulation simulation(sharp({ratio}));
    const vesicle::VectorField& x = simulation.membrane(0).positions();
    const vesicle::VectorField& u = simulation.marker_velocity(0);
    EXPECT_LT((u.col(0) - x.col(2)).abs().maxCoeff(), 1e-12) << ratio;
    EXPECT_LT(u.rightCols<2>().abs().maxCoeff(), 1e-12) << ratio;
  }
}

void expect_same(SceneSimulation& a, SceneSimulation& b) {
  const SimulationState x = a.state(), y = b.state();
  for (std::size_t i = 0; i < x.vesicles.size(); ++i) {
    EXPECT_TRUE((x.vesicles[i].membrane.positions == y.vesicles[i].membrane.positions).all());
    EXPECT_TRUE((x.vesicles[i].membrane.target_areas == y.vesicles[i].membrane.target_areas).all());
    EXPECT_EQ(x.vesicles[i].motion_history, y.vesicles[i].motion_history);
    ASSERT_EQ(x.vesicles[i].interface_velocity.rows(), y.vesicles[i].interface_velocity.rows());
    EXPECT_TRUE((x.vesicles[i].interface_velocity == y.vesicles[i].interface_velocity).all());
    ASSERT_EQ(x.vesicles[i].previous_interface_velocity.rows(), y.vesicles[i].previous_interface_velocity.rows());
    EXPECT_TRUE((x.vesicles[i].previous_interface_velocity == y.vesicles[i].previous_interface_velocity).all());
    EXPECT_EQ(x.vesicles[i].inner_velocities, y.vesicles[i].inner_velocities);
  }
  EXPECT_TRUE(std::equal(x.velocity.x.data(), x.velocity.x.data() + x.velocity.x.size(), y.velocity.x.data()));
  ASSERT_EQ(x.outer_velocities.size(), y.outer_velocities.size());
  for (std::size_t i = 0; i < x.outer_velocities.size(); ++i) {
    const auto &one = x.outer_velocities[i].x, &other = y.outer_velocities[i].x;
    EXPECT_TRUE(std::equal(one.data(), one.data() + one.size(), other.data()));
  }
  EXPECT_TRUE(std::equal(x.pressure.data(), x.pressure.data() + x.pressure.size(), y.pressure.data()));
}

// Also where the start is not over, the markers are redistributed, the box repeats; and handed on once more before any step.
TEST(SharpMembrane, ARestoredRunGoesOnBitForBit) {
  for (const Overrides& overrides : {Overrides{equal},
                                     {five},
                                     {five, "mesh.max_aspect_ratio=1"},
                                     {five, "domain.periodic=[true, true, false]"},
                                     {equal, "fluid.inertia=full"},
                                     {five, "fluid.inertia=full"},
                                     {five, "fluid.inertia=full", "domain.periodic=[true, true, false]"},
                                     {five, "fluid.inertia=unsteady", "time.markers=implicit"}})
    for (const int before : {2, 14}) {
      SceneSimulation whole(sharp(overrides)), restored(sharp(overrides)), again(sharp(overrides));
      advance(whole, before);
      restored.restore(whole.state());
      again.restore(restored.state());
      EXPECT_LT(restored.max_divergence(), 1e-11);
      if (overrides[0] == five && whole.scene().fluid.inertia == fluid::Inertia::none) {
        EXPECT_TRUE((restored.marker_velocity(0) == whole.marker_velocity(0)).all());
      }
      for (SceneSimulation* s : {&whole, &restored, &again}) advance(*s, 4);
      expect_same(whole, restored);
      expect_same(whole, again);
    }
}

TEST(SharpMembrane, AStateMustHaveAVelocityOfTheInterfaceThatIsOne) {
  SceneSimulation simulation(sharp({five}));
  advance(simulation, 1);
  const SimulationState state = simulation.state();
  ASSERT_EQ(state.vesicles[0].interface_velocity.rows(), simulation.membrane(0).positions().rows());
  const auto spoilt = [&](auto spoil) {
    SimulationState other = simulation.state();
    spoil(other.vesicles[0].interface_velocity);
    return other;
  };
  SimulationState without_previous = simulation.state();
  without_previous.vesicles[0].previous_interface_velocity.resize(0, 3);
  EXPECT_NO_THROW(simulation.restore(without_previous));
  without_previous.vesicles[0].previous_interface_velocity.setZero(7, 3);
  EXPECT_THROW(simulation.restore(without_previous), std::invalid_argument);
  EXPECT_THROW(simulation.restore(spoilt([](auto& u) { u.conservativeResize(u.rows() - 1, 3); })),
               std::invalid_argument);
  EXPECT_THROW(simulation.restore(spoilt([](auto& u) { u(3, 1) = INFINITY; })), std::invalid_argument);
  EXPECT_THROW(simulation.restore(spoilt([](auto& u) { u.resize(0, 3); })), std::invalid_argument);
  simulation.step();
  EXPECT_NO_THROW(simulation.restore(state));
}
TEST(SharpMembrane, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const auto positions_with = [](int threads, const char* inertia) {
    omp_set_num_threads(threads);
    SceneSimulation simulation(sharp({five, inertia}));
    advance(simulation, 4);
    return vesicle::VectorField(simulation.membrane(0).positions());
  };
  for (const char* inertia : {"fluid.inertia=none", "fluid.inertia=full"}) {
    const vesicle::VectorField one = positions_with(1, inertia), three = positions_with(3, inertia);
    EXPECT_TRUE((one == three).all()) << inertia;
  }
  omp_set_num_threads(before);
}

TEST(SharpMembrane, WarmedUpStepsAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const Overrides& overrides :
       {Overrides{equal}, {five}, {equal, "fluid.inertia=full"}, {five, "fluid.inertia=full"}}) {
    Overrides all{"mesh.redistribute=never"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    SceneSimulation simulation(sharp(all));
    advance(simulation, 8);
    const long before = test::allocation_count();
    advance(simulation, 2);
    EXPECT_EQ(test::allocation_count() - before, 0) << overrides[0] << ' ' << overrides.back();
  }
  omp_set_num_threads(threads_before);
}

/// Inclination after half a time unit, in radians.
double inclination(const Overrides& overrides) {
  SceneSimulation simulation(sharp(overrides));
  while (simulation.time() < 0.5 - 1e-9) simulation.step();
  return simulation.measure().at(0).inclination_angle;
}

// The two are computed differently: between two viscosities the net flux through the membrane is taken out of the velocity that the
// grid gives, and with one it stays until the shape is held.
TEST(SharpMembrane, TwoViscositiesGoOverIntoOne) {
  SceneSimulation one(sharp({equal, "domain.cells=32"})),
      two(sharp({"fluid.viscosity_ratio=1.00001", "domain.cells=32"}));
  for (SceneSimulation* s : {&one, &two}) advance(*s, 12);
  const vesicle::Diagnostics a = one.measure().at(0), b = two.measure().at(0);
  EXPECT_NEAR(b.inclination_angle, a.inclination_angle, 1e-4);
  EXPECT_NEAR(b.tank_treading_frequency, a.tank_treading_frequency, 1e-4 * a.tank_treading_frequency);
  EXPECT_NEAR(b.deformation, a.deformation, 1e-4 * a.deformation);
}

// At ratio 5, on so coarse a grid, points that change sides leave differences of 1e-4 between any two steps. Extrapolated from two times,
// these errors are of first order: 0.8 in the place of 1.8, and 3.2e-3 in the place of 4e-4.
TEST(SharpMembrane, InertiaOfTwoPhasesIsOfSecondOrderInTime) {
  const auto with_steps = [&](const Overrides& overrides) {  // of the same sigma0
    std::vector<double> found;
    for (const char* step : {"48", "96", "192"}) {
      Overrides all = overrides;
      all.insert(all.end(), {"fluid.inertia=full", std::string("time.step=1/") + step,
                             "membrane.g=" + std::to_string(35.0 * 48.0 / std::stod(step))});
      found.push_back(inclination(all));
    }
    return found;
  };
  const std::vector<double> thin = with_steps({"fluid.viscosity_ratio=0.5", "fluid.reynolds_number=1"});
  EXPECT_GT(std::log2(std::abs((thin[0] - thin[1]) / (thin[1] - thin[2]))), 1.5);
  const std::vector<double> thick = with_steps({five, "fluid.reynolds_number=5"});
  EXPECT_LT(std::abs(thick[0] - thick[2]), 1e-3);
}

// Where ratios tend to one, the flow is that of one fluid; where inertia does, that without it.
TEST(SharpMembrane, InertiaOfTwoPhasesGoesOverIntoThatOfOneAndIntoNone) {
  const char* inertia = "fluid.inertia=full";
  const double one = inclination({equal, inertia, "fluid.reynolds_number=1"});
  EXPECT_NEAR(inclination({"fluid.viscosity_ratio=1.001", inertia, "fluid.reynolds_number=1"}), one, 2e-3);
  EXPECT_GT(std::abs(inclination({five, inertia, "fluid.reynolds_number=1"}) - one), 0.03);
  // Starts from a velocity at rest and from none differ by a part of a step, with one viscosity too.
  const char* short_steps = "time.step=1/96";
  EXPECT_NEAR(inclination({five, inertia, "fluid.reynolds_number=1e-3", short_steps}), inclination({five, short_steps}),
              1e-3);
}

// A sphere in a periodic box whose fluid as a whole stands still. Its membrane keeps the area locally, so that it sinks as a rigid
// one, whatever is inside: with the velocity of Hasimoto (J. Fluid Mech. 5 (1959) 317), 2/9 of the force per volume times
// 1 - 1.7601 c^(1/3) + c - 1.5593 c^2 for the volume fraction c.
Scene sinking_sphere(const char* ratio) {
  Scene scene = small_scene({"coupling.method=sharp", "time.markers=shape_following", "time.step=1/24",
                             "fluid.inertia=none", "membrane.g=70", ratio, "flow.type=rest",
                             "domain.periodic=[true, true, true]", "gravity.acceleration=[0, 0, -1]"});
  scene.vesicles[0] = VesicleParameters{};
  scene.vesicles[0].shape = Shape::sphere;
  scene.vesicles[0].density_difference = 4.5;
  return scene;
}

TEST(SharpMembrane, ASphereSinksAsARigidOneInAPeriodicBox) {
  const double c = 4.0 / 3.0 * std::numbers::pi / 216.0;
  const double hasimoto = 1.0 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c;
  for (const char* ratio : {"fluid.viscosity_ratio=1", "fluid.viscosity_ratio=20"}) {
    SceneSimulation simulation(sinking_sphere(ratio));
    advance(simulation, 12);
    const vesicle::Surface& surface = simulation.membrane(0).surface();
    const vesicle::Vector3 u = surface.integral(simulation.marker_velocity(0)) / surface.area();
    EXPECT_NEAR(-u[2] / hasimoto, 1.0, 0.01) << ratio;
    EXPECT_LT(std::hypot(u[0], u[1]), 1e-3) << ratio;
  }
}

// What another vesicle feels of it does not depend on its inside either.
TEST(SharpMembrane, AVesicleBesideOneOfAnotherViscosityFeelsTheSameFlow) {
  const auto velocity_of_other = [](double ratio) {
    Scene scene = sinking_sphere(equal);
    scene.vesicles[0].viscosity_ratio = ratio;
    scene.vesicles[0].centre = {-1.4, -1.4, 0.0};
    scene.vesicles.push_back(scene.vesicles[0]);
    scene.vesicles[1].viscosity_ratio = 1.0;
    scene.vesicles[1].density_difference = 0.0;
    scene.vesicles[1].centre = {1.5, 1.5, 0.3};
    SceneSimulation simulation(scene);
    advance(simulation, 6);
    const vesicle::Surface& surface = simulation.membrane(1).surface();
    return vesicle::Vector3(surface.integral(simulation.marker_velocity(1)) / surface.area());
  };
  const vesicle::Vector3 equal_inside = velocity_of_other(1.0), thick_inside = velocity_of_other(5.0);
  EXPECT_LT((equal_inside - thick_inside).norm(), 5e-3);
}

// A third of a spacing apart.
Scene two_side_by_side(const Overrides& overrides, double first, double second) {
  Overrides all{"domain.periodic=[true, true, false]"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene scene = sharp(all);
  scene.vesicles[0].shape = Shape::sphere;
  scene.vesicles[0].reduced_volume.reset();
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[0].centre = {first, 0.1, 0.2};
  scene.vesicles[1].centre = {second, 0.1, -0.1};
  return scene;
}

// Across the end of the box as in the middle of it: twelve cells further on all is the same.
TEST(SharpMembrane, NeighboursAreFoundAcrossTheEndOfThePeriod) {
  for (const char* inertia : {"fluid.inertia=none", "fluid.inertia=full"}) {
    const auto velocity = [&](double first, double second) {
      SceneSimulation simulation(two_side_by_side({five, inertia}, first, second));
      advance(simulation, 4);
      return vesicle::VectorField(simulation.marker_velocity(0));
    };
    const double half = 1.03;
    const vesicle::VectorField inside = velocity(-half, half), across = velocity(3.0 - half, -3.0 + half);
    EXPECT_LT((inside - across).abs().maxCoeff(), 1e-6) << inertia;
  }
}

// Each has an inside of its own, which its state has too.
TEST(SharpMembrane, NeighboursWithInertiaGoOnBitForBit) {
  Scene scene = two_side_by_side({five, "fluid.inertia=full"}, -1.03, 1.03);
  scene.vesicles[1].viscosity_ratio = 0.5;
  SceneSimulation whole(scene), restored(scene);
  advance(whole, 5);
  SimulationState state = whole.state();
  restored.restore(state);
  for (SceneSimulation* s : {&whole, &restored}) advance(*s, 3);
  expect_same(whole, restored);
  std::swap(state.vesicles[0].inner_velocities, state.vesicles[1].inner_velocities);
  restored.restore(state);
  advance(restored, 3);
  EXPECT_FALSE((restored.marker_velocity(0) == whole.marker_velocity(0)).all());
  state.vesicles[1].inner_velocities.clear();
  EXPECT_THROW(restored.restore(state), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::sharp_membrane_test
