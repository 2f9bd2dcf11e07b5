// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vesicles that are nearly or exactly spheres: their area cannot be kept by moving along their curvature, which does not vary.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::near_sphere_test {
namespace {

Scene nearly_a_sphere(double reduced_volume, const Overrides& more = {}) {
  Overrides overrides{"time.markers=shape_following", "time.step=1/24", "time.end=1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scene scene = small_scene(overrides);
  scene.membrane.sigma0 = 9000;
  scene.vesicles[0].reduced_volume = reduced_volume;
  return scene;
}

/// The last of a run in which no area has changed by more than its parts have, and no volume at all.
vesicle::Diagnostics last_of(const Scene& scene) {
  SceneSimulation simulation(scene);
  vesicle::Diagnostics d;
  while (!simulation.finished()) {
    simulation.step();
    d = simulation.measure().at(0);
    EXPECT_LE(std::abs(d.area_error), d.max_local_area_error + 1e-12) << simulation.time();
    EXPECT_LT(std::abs(d.volume_error), 1e-12) << simulation.time();
  }
  return d;
}

// An elastic sphere of tension sigma and relative area beyond the sphere's e deforms by f, with e = 2 f^2, until the tension balances the
// flow: 24/55 sigma f = 0.28. With sigma = 9000 e that is e = 2.2e-3 without walls. Errors of 0.8 % of area (sphere) to 16 % (1 - 1e-7) were
// seen where the strain was not tied to the area.
TEST(NearSphere, AreaAndStrainAreContinuousUpToTheSphere) {
  double last_area = -1e-12;
  for (const double deflation : {1e-2, 2e-3, 1e-3, 1e-4, 1e-5, 1e-7, 0.0}) {
    const vesicle::Diagnostics d = last_of(nearly_a_sphere(1.0 - deflation));
    EXPECT_GE(d.area_error, last_area - 1e-5) << deflation;
    EXPECT_LT(d.area_error, 4e-3) << deflation;
    EXPECT_LT(d.max_local_area_error, 6e-3) << deflation;
    EXPECT_NEAR(d.tank_treading_frequency, 0.5, 0.025) << deflation;
    if (deflation >= 2e-3) {
      EXPECT_LT(std::abs(d.area_error), 1e-12) << deflation;
    }
    last_area = d.area_error;
  }
  const double sphere = last_of(nearly_a_sphere(1.0)).area_error;
  EXPECT_GT(sphere, 1.5e-3);
  EXPECT_NEAR(last_area, sphere, 1e-12);
  EXPECT_NEAR(last_of(nearly_a_sphere(1.0 - 1e-7)).area_error, sphere, 2e-5);
}

// A mesh that turned with the axes of the shape, as fast as 25 times the membrane, gave 2 % of area in the first step.
TEST(NearSphere, StartsQuietlyAcrossTheFlow) {
  for (const double deflation : {1e-3, 1e-4, 1e-5}) {
    SceneSimulation simulation(nearly_a_sphere(1.0 - deflation, {"vesicles.0.rotation_deg=0"}));
    for (int i = 0; i < 8; ++i) {
      simulation.step();
      EXPECT_LT(simulation.measure().at(0).max_local_area_error, 6e-3) << deflation << ' ' << i;
    }
  }
}

TEST(NearSphere, ImplicitMarkersAgree) {
  for (const double deflation : {1e-3, 1e-4}) {
    const vesicle::Diagnostics implicit = last_of(nearly_a_sphere(1.0 - deflation, {"time.markers=implicit"}));
    const vesicle::Diagnostics d = last_of(nearly_a_sphere(1.0 - deflation));
    EXPECT_NEAR(implicit.area_error, d.area_error, 3e-5) << deflation;
    EXPECT_NEAR(implicit.tank_treading_frequency, d.tank_treading_frequency, 2e-3) << deflation;
  }
}

TEST(NearSphere, HoldsWithAContrastOfViscosities) {
  for (const double deflation : {1e-4, 1e-7})
    EXPECT_LT(last_of(nearly_a_sphere(1.0 - deflation, {"fluid.viscosity_ratio=5"})).area_error, 4e-3) << deflation;
}

// Nothing pulls at it: bending makes it rounder, so that all of its area is kept by a tension below zero.
TEST(NearSphere, KeepsItsAreaAtRest) {
  for (const double deflation : {1e-3, 1e-4, 1e-5, 1e-7, 0.0}) {
    const vesicle::Diagnostics d = last_of(nearly_a_sphere(1.0 - deflation, {"flow.type=rest"}));
    EXPECT_LT(std::abs(d.area_error), 1e-12) << deflation;
    EXPECT_LT(d.max_local_area_error, 1e-4) << deflation;
  }
}

}  // namespace
}  // namespace vesiflow::coupling::near_sphere_test
