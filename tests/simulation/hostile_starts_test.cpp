// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Starts and flows that a user should not choose: right, refused, or warned of in the plan, but never silently wrong.
// validation/robustness/hostile_starts.py has those that take longer.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "run/plan.h"
#include "run/run_quality.h"
#include "step/blow_up_guard.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::hostile_starts_test {
namespace {

using run::RunQuality;

bool plan_says(const Overrides& overrides, const char* part) {
  return describe_plan(small_scene(overrides), 1).find(part) != std::string::npos;
}

VesicleParameters sphere_of(double radius) {
  VesicleParameters sphere;
  sphere.shape = Shape::sphere;
  sphere.radius = radius;
  return sphere;
}

Scene pair_at(double distance) {
  Scene scene = small_scene({"domain.cells=32"});
  scene.vesicles[0] = sphere_of(0.7);
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[0].centre = {-0.7 - 0.5 * distance, 0, 0};
  scene.vesicles[1].centre = {0.7 + 0.5 * distance, 0, 0};
  return scene;
}

TEST(HostileStarts, PlanWarnsOfFewCellsAcrossAVesicle) {
  const char* warning = "below 8 its frequency";
  EXPECT_FALSE(plan_says({"time.markers=shape_following"}, warning));  // 8 cells
  EXPECT_TRUE(plan_says({"time.markers=shape_following", "domain.cells=12"}, warning));
  EXPECT_TRUE(plan_says({"time.markers=shape_following", "domain.cells=[24, 24, 12]"}, warning));
  EXPECT_TRUE(plan_says({"time.markers=shape_following", "vesicles.0.radius=0.4"}, warning));
}

TEST(HostileStarts, PlanWarnsOfStiffMembranesInLongSteps) {
  const char* warning = "relaxes at a rate of 1/Ca";
  EXPECT_TRUE(plan_says({"membrane.capillary_number=0.015"}, warning));  // steps of 1/96
  EXPECT_FALSE(plan_says({"membrane.capillary_number=0.03"}, warning));
  EXPECT_FALSE(plan_says({"membrane.capillary_number=0.015", "time.adaptive=true"}, warning));
  EXPECT_TRUE(plan_says({"membrane.capillary_number=0.015"}, "or time.adaptive = true"));
  EXPECT_TRUE(plan_says({"membrane.capillary_number=1e-6"}, "is membrane.capillary_number meant?"));
}

// The rim of an oblate presses waves of the mesh together: those that a grid of h = R/20 resolves relax faster there than their degree says, and
// made noise that grew by 1.4 in a step (surface divergence 1.4 here, and 2.5 four steps later).
TEST(HostileStarts, AnOblateAcrossTheFlowIsQuietOnAFineGrid) {
  const Scene scene = parse_scene(R"(
[domain]
lower = [-1.6, 0, -1.6]
upper = [1.6, 1.6, 1.6]
cells = [64, 32, 64]
mirror = [false, true, false]
[coupling]
method = "delta"
[mesh]
latitudes = 32
[time]
step = "1/24"
end = 1
[[vesicles]]
shape = "oblate"
reduced_volume = 0.85
)",
                                  "an oblate");
  SceneSimulation simulation(scene);
  for (int i = 0; i < 12; ++i) simulation.step();
  EXPECT_LT(simulation.measure()[0].surface_divergence_max, 0.02);
}

// What a state that diverges makes of a step is no fault of an argument: the run stops, with the cause.
TEST(HostileStarts, AMembraneTooStiffForTheStepStopsWithItsCause) {
  for (const char* markers : {"shape_following", "euler"})
    for (const char* capillary_number : {"1e-12", "1e-9", "1e-7", "1e-6", "1e-5", "1e-4"}) {
      SceneSimulation simulation(
          small_scene({std::string("membrane.capillary_number=") + capillary_number,
                       std::string("time.markers=") + markers, "time.step=1/24", "membrane.g=1"}));
      try {
        for (int i = 0; i < 3; ++i) {
          simulation.step();
          simulation.measure();
        }
        FAIL() << markers << ", Ca = " << capillary_number << ": should have stopped";
      } catch (const SimulationStopped& reason) {
        EXPECT_NE(reason.advice().find("bending is too fast for the step"), std::string::npos) << reason.advice();
      }
    }
}

TEST(HostileStarts, PlanWarnsOfMarkersFartherApartThanTheGridOrFarCloser) {
  // 16 latitudes on a radius of 1: pi/16 = 0.196, h = 6/cells.
  EXPECT_TRUE(plan_says({}, "spacing about 0.79 h at the equator of a sphere\n"));
  EXPECT_FALSE(plan_says({"domain.cells=36"}, "let the fluid through"));
  EXPECT_TRUE(plan_says({"domain.cells=40"}, "spacing about 1.31 h at the equator of a sphere  <- WARNING"));
  EXPECT_TRUE(plan_says({"domain.cells=40"}, "take mesh.latitudes >= 24"));
  EXPECT_TRUE(plan_says({"vesicles.0.radius=0.3"}, "bring nothing that the fluid's grid resolves"));  // 0.24 h
  const std::string plan = describe_plan(three_vesicles(), 1);  // radius/latitudes: 1/16, 0.8/20, 0.7/12; h = 0.25
  EXPECT_NE(plan.find("spacing about 0.50 to 0.79 h"), std::string::npos) << plan;
}

TEST(HostileStarts, PlanWarnsOfStepsLongerThanRecommendedAndOfInertiaBeyondWhatWasTried) {
  const auto follows = [](const Overrides& overrides) {
    Scene scene = small_scene(overrides);
    scene.g.reset();
    scene.membrane.sigma0 = 2000;
    scene.time.markers = MarkerMotion::shape_following;
    return describe_plan(scene, 1);
  };
  const char* step = "the flow turns by more than 1/12 in a step";
  EXPECT_EQ(follows({"time.step=1/12"}).find(step), std::string::npos);
  EXPECT_NE(follows({"time.step=1/10"}).find(step), std::string::npos);
  EXPECT_NE(follows({"time.step=1/12", "flow.rate=1.5"}).find("take time.step <= 0.0556"), std::string::npos);
  const char* tension = "quiet to about 112 at this Reynolds number";
  EXPECT_EQ(follows({"time.step=1/24"}).find("at this Reynolds number"), std::string::npos);
  EXPECT_NE(follows({"time.step=1/24", "fluid.reynolds_number=1"}).find(tension), std::string::npos);  // g = 83
  EXPECT_EQ(follows({"time.step=1/24", "fluid.reynolds_number=1"}).find("WARNING: beyond it"), std::string::npos);
  EXPECT_NE(follows({"time.step=1/24", "fluid.reynolds_number=10"}).find("WARNING: beyond it"), std::string::npos);
  EXPECT_NE(follows({"fluid.reynolds_number=11"}).find("has been compared with nothing"), std::string::npos);
  EXPECT_EQ(follows({"fluid.reynolds_number=10"}).find("has been compared with nothing"), std::string::npos);
}

TEST(HostileStarts, PlanWarnsOfMoreMemoryThanThereIs) {
  EXPECT_FALSE(plan_says({}, "fewer domain.cells or mesh.latitudes take less"));
  EXPECT_TRUE(plan_says({"domain.cells=2048"}, "MB: fewer domain.cells or mesh.latitudes take less"));
}

TEST(HostileStarts, PlanWarnsOfDeflatedVesicles) {
  EXPECT_FALSE(plan_says({"vesicles.0.reduced_volume=0.644"}, "most runs stop"));  // of a red cell, whose scene runs
  EXPECT_TRUE(plan_says({"vesicles.0.reduced_volume=0.62"}, "reduced volume                  0.62 at the start"));
  EXPECT_TRUE(plan_says({"vesicles.0.reduced_volume=0.62"}, "most runs stop"));
  EXPECT_FALSE(plan_says({"vesicles.0.reduced_volume=0.9", "membrane.capillary_number=30"}, "noisy or stop"));
  EXPECT_TRUE(plan_says({"vesicles.0.reduced_volume=0.85", "membrane.capillary_number=30"}, "noisy or stop"));
  EXPECT_FALSE(
      plan_says({"vesicles.0.reduced_volume=0.85", "membrane.capillary_number=30", "flow.type=rest"}, "noisy"));
}

TEST(HostileStarts, PlanWarnsOfMembranesNearEachOtherAndNearWalls) {
  const auto warns = [](const Scene& scene) {
    return describe_plan(scene, 1).find("is not resolved below 2 h") != std::string::npos;
  };
  EXPECT_FALSE(warns(pair_at(0.45)));
  EXPECT_TRUE(warns(pair_at(0.3)));                                                         // h = 0.1875
  EXPECT_FALSE(plan_says({"vesicles.0.centre=[0, 1.4, 0]"}, "is not resolved below 2 h"));  // y semi-axis 0.83: 3 h
  EXPECT_TRUE(plan_says({"vesicles.0.centre=[0, 1.75, 0]"}, "is not resolved below 2 h"));
  EXPECT_THROW(small_scene({"vesicles.0.centre=[0, 1.9, 0]"}), SceneError);
}

TEST(HostileStarts, ARunWarnsOfMembranesThatCameNearEachOtherOrAWall) {
  const auto said = [](const Scene& scene) {
    SceneSimulation simulation(scene);
    RunQuality quality(simulation.scene());
    quality.observe(simulation, simulation.measure(), simulation.nearest_distances());
    std::string all;
    for (const std::string& warning : quality.warnings()) all += warning + "\n";
    return all;
  };
  EXPECT_EQ(said(pair_at(0.45)).find("came within"), std::string::npos);
  EXPECT_NE(said(pair_at(0.3)).find("a membrane came within 1.6 spacings of another"),
            std::string::npos);  // h = 0.1875
  EXPECT_EQ(said(small_scene({"vesicles.0.centre=[0, 1.4, 0]"})).find("came within"), std::string::npos);
  EXPECT_NE(said(small_scene({"vesicles.0.centre=[0, 1.75, 0]"})).find("spacings of a wall"), std::string::npos);
  // What no run can help is known before it starts, and said there.
  EXPECT_EQ(said(small_scene({"fluid.viscosity_ratio=5"})), said(small_scene()));
  EXPECT_TRUE(plan_says({"fluid.viscosity_ratio=5"}, "of first order in the spacing"));
  EXPECT_FALSE(plan_says({}, "of first order in the spacing"));
}

// The tension of before the turn takes part of a unit of time to change its sign, and the step of the turn is one of first order.
TEST(HostileStarts, AFlowThatTurnsRoundIsFollowed) {
  const auto after = [](const char* markers, const char* step) {
    Scene scene =
        small_scene({std::string("time.markers=") + markers, std::string("time.step=") + step, "time.end=1.5"});
    scene.membrane.sigma0 = 2000;
    const double turn = 0.5 * scene.time.end + 1e-9;
    SceneSimulation simulation(
        scene,
        [turn](const fluid::Vector3& r, double t) {
          return fluid::Vector3{t <= turn ? r[2] : -r[2], 0.0, 0.0};
        },
        fluid::WallMotion::unsteady);
    while (!simulation.finished()) simulation.step();
    return simulation.measure()[0];
  };
  const auto exact = after("implicit", "1/192");
  const auto fine = after("shape_following", "1/96"), coarse = after("shape_following", "1/48");
  const double error = std::abs(fine.deformation - exact.deformation);
  EXPECT_LT(error, 5e-3 * exact.deformation);
  EXPECT_LT(error, 0.6 * std::abs(coarse.deformation - exact.deformation));
  EXPECT_NEAR(fine.inclination_angle, exact.inclination_angle, 0.01);
}

// The delta function answers most where it is narrow: g is that of the finest spacing, along whichever axis.
TEST(HostileStarts, TensionNumberIsOfTheFinestSpacing) {
  for (const char* cells : {"domain.cells=[48, 24, 24]", "domain.cells=[24, 48, 24]", "domain.cells=[24, 24, 48]"}) {
    const Scene scene = small_scene({"membrane.g=2", cells});
    EXPECT_DOUBLE_EQ(scene.finest_spacing(), 0.125);
    EXPECT_DOUBLE_EQ(scene.spacing(), 0.25);
    EXPECT_NEAR(scene.membrane.sigma0, 2.0 * 4 * 0.125 * 96, 1e-9);
    EXPECT_NEAR(scene.tension_number(), 2.0, 1e-12);
  }
  EXPECT_TRUE(plan_says({"membrane.g=2", "domain.cells=[48, 24, 24]"}, "spacing 0.125 to 0.25"));
}

// With spacings of 1 : 4 the estimate of the answer by the largest spacing was too small by four: noise of 40 shear rates, and no word of it.
TEST(HostileStarts, ShapeFollowingIsQuietOnUnequalSpacings) {
  const auto divergence = [](const char* cells) {
    Scene scene = small_scene({"domain.lower=[-3, -2, -2]", "domain.upper=[3, 2, 2]", cells,
                               "time.markers=shape_following", "time.step=1/24", "time.end=2"});
    scene.membrane.sigma0 = 2000;
    SceneSimulation simulation(scene);
    while (!simulation.finished()) simulation.step();
    return simulation.measure()[0].surface_divergence_max;
  };
  EXPECT_LT(divergence("domain.cells=[48, 8, 8]"), 0.5);
}

// Adams-Bashforth is stable on half of Euler's real interval, and a thin membrane answers faster than a thick one.
TEST(HostileStarts, StableTensionNumberKnowsTheIntegrator) {
  const auto limit = [](const Overrides& overrides) { return small_scene(overrides).stable_tension_number(); };
  EXPECT_EQ(limit({"membrane.g=2"}), 7.0);
  EXPECT_EQ(limit({"membrane.g=2", "time.markers=ab2"}), 3.5);
  EXPECT_EQ(limit({"membrane.g=2", "coupling.thickness_correction=true"}), 2.0);
  EXPECT_EQ(limit({"membrane.g=2", "time.markers=strain_relaxation"}), 49.0);
  EXPECT_TRUE(plan_says({"membrane.g=4", "time.markers=ab2"}, "stable below about 3.5  <- WARNING: beyond it"));
  EXPECT_THROW(small_scene({"membrane.g=8.5", "time.markers=ab2"}), SceneError);
}

// With shape following g has a limit where inertia counts, and none elsewhere.
TEST(HostileStarts, AdviceSpeaksOfGOnlyWhereItHasALimit) {
  const auto advice = [](const char* reynolds_number) {
    const Scene scene = small_scene(
        {"time.markers=shape_following", "membrane.g=200", std::string("fluid.reynolds_number=") + reynolds_number});
    return blow_up_advice(scene, flow_of(scene));
  };
  EXPECT_NE(advice("1").find("here g = 200"), std::string::npos);
  EXPECT_EQ(advice("1e-3").find("g ="), std::string::npos);
}

TEST(HostileStarts, PlanWarnsOfAnImplicitContrastWithShapeFollowing) {
  const auto warns = [](const char* ratio, const char* markers) {
    return plan_says({"fluid.viscous_treatment=implicit", std::string("fluid.viscosity_ratio=") + ratio,
                      std::string("time.markers=") + markers},
                     "at this contrast");
  };
  EXPECT_TRUE(warns("20", "shape_following"));
  EXPECT_TRUE(warns("0.05", "shape_following"));
  EXPECT_FALSE(warns("5", "shape_following"));
  EXPECT_FALSE(warns("20", "euler"));
}

// A vesicle that is 20 times thinner than the fluid around it: the viscosity that is extrapolated made waves of its membrane grow, with short steps
// slowly and from round-off (4e-6 at t = 4.2 with a third of the present estimate of stiffness).
TEST(HostileStarts, AThinFluidInsideIsQuiet) {
  const auto noise_after = [](const char* step, const char* end) {
    Scene scene =
        small_scene({"fluid.viscosity_ratio=0.05", "time.markers=shape_following", std::string("time.step=") + step,
                     std::string("time.end=") + end, "domain.lower=[-3, 0, -3]", "domain.cells=[24, 12, 24]",
                     "domain.mirror=[false, true, false]"});
    scene.membrane.sigma0 = 2000;
    SceneSimulation simulation(scene);
    while (!simulation.finished()) simulation.step();
    EXPECT_LT(simulation.measure()[0].surface_divergence_max, 0.1);
    return simulation.velocity_noise(0);
  };
  EXPECT_LT(noise_after("1/48", "4"), 1e-5);
  EXPECT_LT(noise_after("1/192", "4.5"), 1e-7);
}

}  // namespace
}  // namespace vesiflow::coupling::hostile_starts_test
