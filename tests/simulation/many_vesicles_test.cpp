// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Several vesicles, each with its own properties, and forces from outside.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "coupling/overlap.h"
#include "coupling/simulation.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::many_vesicles_test {
namespace {

void advance(SceneSimulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) simulation.step();
}

double centroid_z(SceneSimulation& simulation, std::size_t vesicle = 0) {
  return simulation.measure().at(vesicle).centroid.z();
}

TEST(ManyVesicles, HaveTheirOwnProperties) {
  SceneSimulation simulation(three_vesicles());
  const vesicle::MembraneParameters second = simulation.membrane(1).parameters();
  EXPECT_EQ(simulation.membrane(0).positions().rows(), 2 * 16 * 16);
  EXPECT_EQ(simulation.membrane(1).positions().rows(), 2 * 20 * 20);
  EXPECT_EQ(simulation.membrane(2).positions().rows(), 2 * 12 * 12);
  EXPECT_EQ(second.capillary_number, 1.0);
  EXPECT_EQ(second.spontaneous_curvature, 0.3);
  EXPECT_EQ(simulation.membrane(2).parameters().sigma0, 200.0);
  EXPECT_EQ(second.sigma0, simulation.membrane(0).parameters().sigma0);
}

TEST(ManyVesicles, DoNotDependOnTheirOrder) {
  const Scene scene = three_vesicles();
  Scene turned = scene;
  turned.vesicles = {scene.vesicles[2], scene.vesicles[0], scene.vesicles[1]};
  SceneSimulation a(scene), b(turned);
  advance(a, 20);
  advance(b, 20);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((a.membrane(i).positions() - b.membrane((i + 1) % 3).positions()).abs().maxCoeff(), 1e-11) << i;
  const std::vector<double> distances = a.nearest_distances(), others = b.nearest_distances();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(distances[i], others[(i + 1) % 3], 1e-11);
}

TEST(ManyVesicles, GiveTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const auto positions_with = [](int threads) {
    omp_set_num_threads(threads);
    SceneSimulation simulation(three_vesicles());
    advance(simulation, 5);
    return vesicle::VectorField(simulation.membrane(1).positions());
  };
  const vesicle::VectorField one = positions_with(1), two = positions_with(2);
  omp_set_num_threads(before);
  EXPECT_TRUE((one == two).all());
}

TEST(ManyVesicles, AWarmedUpStepAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  SceneSimulation simulation(three_vesicles());
  advance(simulation, 3);
  const long before = test::allocation_count();
  advance(simulation, 2);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

// Two spheres at rest, a tenth apart, move apart as mirror images of each other; without repulsion they stay.
TEST(ManyVesicles, AreDrivenApartByRepulsion) {
  const auto separate = [](double strength) {
    Scene scene = small_scene({"flow.type=rest", "repulsion.range=0.4"});
    scene.repulsion.strength = strength;
    VesicleParameters sphere;
    sphere.shape = Shape::sphere;
    sphere.radius = 0.7;
    sphere.centre = {-0.75, 0, 0};
    scene.vesicles = {sphere, sphere};
    scene.vesicles[1].centre[0] = 0.75;
    auto simulation = std::make_unique<SceneSimulation>(scene);
    advance(*simulation, 40);
    return simulation;
  };
  const auto with = separate(200.0), without = separate(0.0);
  const double left = with->measure()[0].centroid.x(), right = with->measure()[1].centroid.x();
  EXPECT_GT(right, 0.755);
  EXPECT_NEAR(left, -right, 1e-12);
  EXPECT_NEAR(without->measure()[1].centroid.x(), 0.75, 1e-6);
  EXPECT_GT(with->nearest_distances()[0], without->nearest_distances()[0] + 1e-3);
  EXPECT_FALSE(overlap(with->membrane(0).surface(), with->membrane(1).positions()));
}

// Where a periodic box is cut makes no difference: a vesicle half outside, or some periods away, moves as one in the middle.
TEST(ManyVesicles, AreTheSameAcrossPeriodicSides) {
  const auto moved_to = [](double x, double y, double viscosity_ratio) {
    Scene scene = small_scene({"domain.periodic=[true, true, false]"});
    scene.fluid.viscosity_ratio = viscosity_ratio;
    scene.vesicles[0].centre = {x, y, 0.0};
    SceneSimulation simulation(scene);
    advance(simulation, 10);
    vesicle::VectorField markers = simulation.membrane(0).positions();
    markers.col(0) -= x;
    markers.col(1) -= y;
    return markers;
  };
  for (const double ratio : {1.0, 5.0}) {
    const vesicle::VectorField middle = moved_to(0.0, 0.0, ratio);
    EXPECT_LT((moved_to(3.0, -2.5, ratio) - middle).abs().maxCoeff(), 1e-9) << ratio;  // whole cells of 1/4
    EXPECT_LT((moved_to(-23.0, 12.75, ratio) - middle).abs().maxCoeff(), 1e-9) << ratio;
  }
}

Scene heavy_sphere(double density_difference, const Overrides& overrides = {}) {
  Overrides all = {"flow.type=rest", "gravity.acceleration=[0, 0, -2]", "time.step=1/384"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene scene = small_scene(all);
  VesicleParameters& sphere = scene.vesicles[0];
  sphere = {};
  sphere.shape = Shape::sphere;
  sphere.density_difference = density_difference;
  return scene;
}

// The box and the sphere are their own mirror images: a light sphere rises as a heavy one sinks, and nothing goes sideways.
TEST(ManyVesicles, AHeavySphereSinksAsALightOneRises) {
  SceneSimulation heavy(heavy_sphere(1.5)), light(heavy_sphere(-1.5));
  advance(heavy, 20);
  advance(light, 20);
  const vesicle::Diagnostics d = heavy.measure().at(0);
  EXPECT_LT(d.centroid.z(), -1e-3);
  EXPECT_NEAR(centroid_z(light), -d.centroid.z(), 1e-12);
  EXPECT_NEAR(d.centroid.x(), 0.0, 1e-12);
  EXPECT_NEAR(d.centroid.y(), 0.0, 1e-12);
}

// With no walls the fluid as a whole stays at rest: the weight is balanced by the mean pressure gradient.
TEST(ManyVesicles, APeriodicBoxStaysAtRestAsAWhole) {
  for (const char* inertia : {"full", "none"}) {
    SceneSimulation simulation(
        heavy_sphere(1.5, {"domain.periodic=[true, true, true]", std::string("fluid.inertia=") + inertia}));
    advance(simulation, 5);
    double sum = 0.0, largest = 0.0;
    const fluid::ConstView w = simulation.fluid().velocity().z.unknowns();
    for (int k = 0; k < w.extent[2]; ++k)
      for (int j = 0; j < w.extent[1]; ++j)
        for (int i = 0; i < w.extent[0]; ++i) {
          sum += w(i, j, k);
          largest = std::max(largest, std::abs(w(i, j, k)));
        }
    EXPECT_GT(largest, 0.1) << inertia;
    EXPECT_LT(std::abs(sum) / (24 * 24 * 24), 1e-10 * largest) << inertia;
  }
}

// Nor do the forces that shape_following owes the fluid set it in motion, whose sum over a shape is not zero by itself.
TEST(ManyVesicles, APeriodicBoxStaysAtRestWithWhatMotionsOwe) {
  Scene scene = heavy_sphere(1.5, {"domain.periodic=[true, true, true]", "time.markers=shape_following",
                                   "time.step=1/24", "domain.cells=16", "mesh.latitudes=12"});
  scene.vesicles[0].harmonics = {};
  scene.vesicles[0].shape = Shape::prolate;
  scene.vesicles[0].reduced_volume = 0.85;
  scene.vesicles[0].rotation_deg = 40;
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[1].centre = {1.5, 2.6, 2.0};
  scene.vesicles[1].radius = 0.5;
  scene.vesicles[1].density_difference = 0.0;
  SceneSimulation simulation(scene);
  advance(simulation, 8);
  for (const fluid::ConstView& component :
       {simulation.fluid().velocity().x.unknowns(), simulation.fluid().velocity().z.unknowns()}) {
    double sum = 0.0, largest = 0.0;
    for (int k = 0; k < component.extent[2]; ++k)
      for (int j = 0; j < component.extent[1]; ++j)
        for (int i = 0; i < component.extent[0]; ++i) {
          sum += component(i, j, k);
          largest = std::max(largest, std::abs(component(i, j, k)));
        }
    EXPECT_LT(std::abs(sum) / (16 * 16 * 16), 1e-10 * largest);
  }
}

// The surface of a sphere that cannot stretch does not flow in its own plane: it sinks as a rigid one. In a cubic array of volume
// fraction c, at no mean flow, F = 6 pi a U/(1 - 1.7601 c^(1/3) + c - 1.5593 c^2) (Hasimoto, J. Fluid Mech. 5 (1959) 317).
// The spread membrane is a few tenths of a cell thick: an error of first order, which two more grids take away.
TEST(ManyVesicles, APeriodicArrayOfSpheresSinksAsHasimotoFound) {
  const double volume = 4 * std::numbers::pi / 3, c = volume / (6 * 6 * 6);
  const double hasimoto =
      1.5 * 2.0 * volume / (6 * std::numbers::pi) * (1 - 1.7601 * std::cbrt(c) + c - 1.5593 * c * c);
  const auto speed = [&](const char* cells, const char* latitudes) {
    SceneSimulation simulation(heavy_sphere(
        1.5, {"domain.periodic=[true, true, true]", "mesh.tangential_degrees=12", std::string("domain.cells=") + cells,
              std::string("mesh.latitudes=") + latitudes, "membrane.g=3"}));
    advance(simulation, 10);
    const double start = centroid_z(simulation), time = simulation.time();
    advance(simulation, 5);
    return (start - centroid_z(simulation)) / (simulation.time() - time) / hasimoto;
  };
  const double at_16 = speed("16", "12"), at_24 = speed("24", "16"), at_48 = speed("48", "32");  // h = 3, 2, 1 eighths
  EXPECT_NEAR((1 - at_24) / (1 - at_48), 2.0, 0.3);
  EXPECT_NEAR(3 * at_48 - 3 * at_24 + at_16, 1.0, 0.02);
}

}  // namespace
}  // namespace vesiflow::coupling::many_vesicles_test
