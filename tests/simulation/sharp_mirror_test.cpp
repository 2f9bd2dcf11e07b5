// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Halves and quarters of symmetric boxes (domain.mirror) against the whole, with coupling.method = "sharp".
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "coupling/errors.h"
#include "coupling/initial_shape.h"
#include "coupling/simulation.h"
#include "mirrored_scenes.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::sharp_mirror_test {
namespace {

using mirrored::advance, mirrored::expect_same, mirrored::side_of;

constexpr long steps = 6;

Scene sharp(const Overrides& more) {
  Overrides overrides{"coupling.method=sharp",
                      "time.markers=shape_following",
                      "time.step=1/24",
                      "fluid.inertia=none",
                      "membrane.g=70",
                      "domain.lower=[-2.5, -2, -2]",
                      "domain.upper=[2.5, 2, 2]",
                      "domain.cells=[20, 16, 16]",
                      "vesicles.0.reduced_volume=0.9"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return small_scene(overrides);
}

const std::vector<Overrides> fluids{{"fluid.viscosity_ratio=1"},
                                    {"fluid.viscosity_ratio=5"},
                                    {"fluid.viscosity_ratio=1", "fluid.inertia=full", "fluid.reynolds_number=1"},
                                    {"fluid.viscosity_ratio=5", "fluid.inertia=full", "fluid.reynolds_number=1"}};

Overrides both(Overrides overrides, const Overrides& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

std::string described(const Overrides& overrides) {
  std::string text;
  for (const std::string& one : overrides) text += one + " ";
  return text;
}

// The fluid's equations are solved to round-off, or to a tolerance that is far below these differences. They are those of the
// whole from its mirror image, whose points find their feet on the membrane by steps of single precision.
constexpr double tolerance = 2e-9;

/// The largest difference of u_x from its mirror image in y.
double asymmetry(const fluid::FaceVector& velocity) {
  const auto& u = velocity.x;
  double most = 0.0;
  for (int k = 0; k < u.extent(2); ++k)
    for (int j = 0; j < u.extent(1); ++j)
      for (int i = 0; i < u.extent(0); ++i) most = std::max(most, std::abs(u(i, j, k) - u(i, u.extent(1) - 1 - j, k)));
  return most;
}

TEST(SharpMirror, HalfOfAShearFlowIsTheHalfOfTheWhole) {
  for (const Overrides& fluid : fluids)
    for (const char* periodic : {"domain.periodic=[false, false, false]", "domain.periodic=[true, false, false]"}) {
      SCOPED_TRACE(described(fluid) + periodic);
      const Scene scene = sharp(both(fluid, {periodic, "vesicles.0.rotation_deg=60"}));
      SceneSimulation whole(scene), half(side_of(scene, {false, true, false}));
      advance(whole, steps);
      advance(half, steps);
      // 5e-8 with two phases of inertia, which change sides within a quarter of a spacing, and below 3e-10 without.
      const double of_the_whole = asymmetry(whole.fluid().velocity());
      EXPECT_LT(of_the_whole, 2e-7);
      expect_same(whole, half, tolerance + 2.0 * of_the_whole);
      EXPECT_LT(mirrored::difference(whole.fluid_velocity(), half.fluid_velocity()), tolerance + 2.0 * of_the_whole);
      EXPECT_LT(mirrored::difference(half.fluid_velocity(), fluid_velocity_of(half.scene(), half.state())), 1e-14);
    }
}

// Its steps repeat until they agree to 1e-6, with differences of that order.
TEST(SharpMirror, ImplicitStepsOfTheHalfAreThoseOfTheWhole) {
  const Scene scene = sharp({"fluid.viscosity_ratio=5", "time.markers=implicit", "vesicles.0.rotation_deg=60"});
  SceneSimulation whole(scene), half(side_of(scene, {false, true, false}));
  advance(whole, 4);
  advance(half, 4);
  expect_same(whole, half, 1e-6);
}

TEST(SharpMirror, QuarterOfADuctIsTheQuarterOfTheWhole) {
  for (const Overrides& fluid : fluids) {
    SCOPED_TRACE(described(fluid));
    const Scene scene = sharp(both(fluid, {"flow.type=duct", "vesicles.0.rotation_deg=90"}));
    SceneSimulation whole(scene), quarter(side_of(scene, {false, true, true}));
    advance(whole, steps);
    advance(quarter, steps);
    expect_same(whole, quarter, tolerance);
    EXPECT_LT(mirrored::difference(whole.fluid_velocity(), quarter.fluid_velocity()), tolerance);
  }
}

// Along x as well, where the lines of points inside begin on the plane.
TEST(SharpMirror, EighthOfAnExtensionIsTheEighthOfTheWhole) {
  for (const Overrides& fluid : fluids) {
    SCOPED_TRACE(described(fluid));
    const Scene scene = sharp(both(fluid, {"flow.type=extension", "domain.lower=[-2, -2, -2]", "domain.upper=[2, 2, 2]",
                                           "domain.cells=[28, 28, 28]", "vesicles.0.rotation_deg=0"}));
    SceneSimulation whole(scene), eighth(side_of(scene, {true, true, true}));
    advance(whole, 3);
    advance(eighth, 3);
    // The whole is symmetric about the equator of the mesh to the error of Newton's method only, and on coarser grids less so: what
    // markers read in the middle of the body is no longer known there.
    expect_same(whole, eighth, 1e-6);
    EXPECT_LT(mirrored::difference(whole.fluid_velocity(), eighth.fluid_velocity()), 1e-6);
  }
}

/// Two vesicles, mirror images of each other in y = 0 and that far off it, beside a third that lies across; and the half box of it.
struct Pair {
  explicit Pair(const Overrides& more, double gap, bool has_third) {
    Overrides overrides{"domain.lower=[-2, -3.5, -2]", "domain.upper=[4.5, 3.5, 2]", "domain.cells=[26, 28, 16]",
                        "vesicles.0.radius=0.8"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    whole = sharp(overrides);
    VesicleParameters aside;
    aside.shape = Shape::oblate;
    aside.aspect_ratio = 1.25;
    aside.radius = 0.85;
    aside.centre = {1.75, 0.0, 0.1};
    aside.rotation_axis = {1, 0, 0};
    aside.rotation_deg = 20;
    const vesicle::VectorField markers = initial_markers(aside, whole.latitudes(0));
    aside.centre[1] = gap - markers.col(1).minCoeff();
    whole.vesicles.push_back(aside);
    if (!has_third) whole.vesicles.erase(whole.vesicles.begin());
    half = side_of(whole, {false, true, false});
    aside.centre[1] *= -1.0;
    aside.rotation_deg *= -1.0;
    whole.vesicles.push_back(aside);
  }
  Scene whole, half;
};

// A third of a spacing off the plane; of two viscosities with inertia as far as phases of several membranes are kept apart.
TEST(SharpMirror, AVesicleOnOneSideStandsForItsImageToo) {
  for (const Overrides& fluid : fluids)
    for (const bool has_third : {false, true}) {
      const bool two_phases = &fluid == &fluids.back();
      if (two_phases && has_third) continue;
      SCOPED_TRACE(described(fluid) + (has_third ? ", with a third" : ""));
      const Pair pair(fluid, two_phases ? 0.7 : 0.08, has_third);
      SceneSimulation whole(pair.whole), half(pair.half);
      advance(whole, steps);
      advance(half, steps);
      expect_same(whole, half, tolerance);
      EXPECT_LT(mirrored::difference(whole.fluid_velocity(), half.fluid_velocity()), tolerance);
    }
}

TEST(SharpMirror, PhasesWithInertiaMustKeepOffTheirImage) {
  const Pair near(fluids.back(), 0.45, false), far(fluids.back(), 0.55, false);
  SceneSimulation too_near(near.half), far_enough(far.half);
  try {
    too_near.step();
    FAIL() << "no exception";
  } catch (const SimulationStopped& stopped) {
    EXPECT_NE(std::string(stopped.what()).find("vesicle 0 is 1.8 grid spacings from the plane of symmetry y = 0"),
              std::string::npos)
        << stopped.what();
  }
  EXPECT_NO_THROW(far_enough.step());
}

TEST(SharpMirror, ARestoredRunGoesOnBitForBit) {
  for (const Overrides& fluid : fluids) {
    SCOPED_TRACE(described(fluid));
    const Scene scene = side_of(sharp(both(fluid, {"vesicles.0.rotation_deg=60"})), {false, true, false});
    SceneSimulation whole(scene), restored(scene);
    advance(whole, 5);
    restored.restore(whole.state());
    advance(whole, 3);
    advance(restored, 3);
    EXPECT_TRUE((whole.membrane(0).positions() == restored.membrane(0).positions()).all());
    EXPECT_TRUE((whole.marker_velocity(0) == restored.marker_velocity(0)).all());
    EXPECT_EQ(mirrored::difference(whole.fluid().velocity(), restored.fluid().velocity()), 0.0);
  }
}

// What round-off puts between U and its mirror image would be multiplied by the ratio in every solve.
TEST(SharpMirror, MarkersAndVelocitiesStaySymmetric) {
  for (const char* markers : {"shape_following", "implicit"})
    for (const Overrides& fluid : fluids) {
      SCOPED_TRACE(described(fluid) + markers);
      const Overrides more{std::string("time.markers=") + markers, "vesicles.0.rotation_deg=60"};
      SceneSimulation half(side_of(sharp(both(fluid, more)), {false, true, false}));
      advance(half, 12);
      const Eigen::Index longitudes = 2 * half.scene().latitudes(0), latitudes = half.scene().latitudes(0);
      const auto asymmetry = [&](const vesicle::VectorField& x) {
        double worst = 0.0;
        for (Eigen::Index j = 0; j < latitudes; ++j)
          for (Eigen::Index i = 0; i < longitudes; ++i) {
            const Eigen::Index a = j * longitudes + i, b = j * longitudes + (longitudes - i) % longitudes;
            worst = std::max(
                {worst, std::abs(x(a, 0) - x(b, 0)), std::abs(x(a, 1) + x(b, 1)), std::abs(x(a, 2) - x(b, 2))});
          }
        return worst;
      };
      EXPECT_LT(asymmetry(half.membrane(0).positions()), 2e-15);
      EXPECT_LT(asymmetry(half.marker_velocity(0)), 1e-11);
    }
}

TEST(SharpMirror, GivesTheSameBitsForEveryNumberOfThreads) {
  const int before = omp_get_max_threads();
  const auto positions_with = [](int threads) {
    omp_set_num_threads(threads);
    SceneSimulation half(side_of(sharp(fluids.back()), {false, true, false}));
    advance(half, 3);
    return vesicle::VectorField(half.membrane(0).positions());
  };
  const vesicle::VectorField one = positions_with(1), three = positions_with(3);
  omp_set_num_threads(before);
  EXPECT_TRUE((one == three).all());
}

TEST(SharpMirror, WarmedUpStepsAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(2);  // with one the OpenMP library itself allocates a team for every loop
  for (const Overrides& fluid : fluids) {
    SceneSimulation half(side_of(sharp(both(fluid, {"mesh.redistribute=never"})), {false, true, false}));
    advance(half, 8);
    const long before = test::allocation_count();
    advance(half, 2);
    EXPECT_EQ(test::allocation_count() - before, 0) << described(fluid);
  }
  omp_set_num_threads(threads_before);
}

}  // namespace
}  // namespace vesiflow::coupling::sharp_mirror_test
