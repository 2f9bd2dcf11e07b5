// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/cost_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::run::cost_model_test {
namespace {

std::map<std::string, PhaseCost> costs_of(const Scene& scene) {
  std::map<std::string, PhaseCost> costs;
  for (const PhaseCost& cost : estimate_costs(scene)) costs[cost.phase] = cost;
  return costs;
}

// As bench/step takes it.
Scene benchmark_scene(int cells, int latitudes, double ratio) {
  Scene scene;
  scene.domain.cells.fill(cells);
  scene.fluid.viscosity_ratio = ratio;
  scene.mesh.latitudes = latitudes;
  scene.time.step = ratio == 1.0 ? 1.0 / 24.0 : 1.0 / 48.0;
  scene.vesicles.resize(1);
  scene.vesicles[0].reduced_volume = 0.9;
  return scene;
}

double cost(const Scene& scene, const char* phase) {
  return costs_of(scene).at(phase).seconds;
}

// Milliseconds per step of shape_following with one thread, by
//   OMP_WAIT_POLICY=passive bench/step --cells 64 128 256 --ratio 20 --json
// on a machine with nothing else to do (2.6 GHz, AVX2): what the constants were fitted to.
TEST(CostModel, IsWithinAFactorOfTwoOfMeasuredTimesRegression) {
  struct Measured {
    int cells, latitudes;
    double membrane, spread, interpolate, mesh, convection, momentum, projection, indicator, viscous;
  };
  constexpr Measured all[] = {{64, 32, 1.3, 0.67, 0.32, 0.92, 3.1, 5.4, 3.0, 2.6, 3.4},
                              {128, 64, 6.7, 2.9, 1.5, 4.4, 27.5, 53.5, 30.0, 24.0, 27.0},
                              {256, 96, 24.0, 12.0, 4.2, 20.0, 299.0, 441.0, 281.0, 216.0, 248.0}};
  for (const Measured& m : all) {
    auto costs = costs_of(benchmark_scene(m.cells, m.latitudes, 20.0));
    const auto expect_near = [&](const char* phase, double milliseconds) {
      const double quotient = 1e3 * costs.at(phase).seconds / milliseconds;
      EXPECT_GT(quotient, 0.5) << phase << " " << m.cells;
      EXPECT_LT(quotient, 2.0) << phase << " " << m.cells;
    };
    expect_near("membrane", m.membrane);
    expect_near("spread", m.spread);
    expect_near("interpolate", m.interpolate);
    expect_near("mesh", m.mesh);
    expect_near("fluid_convection", m.convection);
    expect_near("fluid_momentum", m.momentum);
    expect_near("fluid_projection", m.projection);
    expect_near("indicator", m.indicator);
    expect_near("fluid_viscous", m.viscous);
  }
}

TEST(CostModel, SharesAddUpToOneAndWhatIsOffHasNoneAndAReason) {
  for (const Overrides& overrides : {Overrides{}, Overrides{"fluid.viscosity_ratio=5"}, Overrides{"fluid.inertia=none"},
                                     Overrides{"time.adaptive=true", "mesh.redistribute=never"},
                                     Overrides{"output.diagnostics_every=0", "output.vesicle_every=0",
                                               "output.fluid_every=0", "output.checkpoint_every=0"}}) {
    double sum = 0.0;
    for (const PhaseCost& cost : estimate_costs(coupling::small_scene(overrides))) {
      sum += cost.share;
      EXPECT_EQ(cost.off.empty(), cost.seconds > 0.0) << cost.phase;
      EXPECT_EQ(cost.off.empty(), cost.share > 0.0) << cost.phase;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

// Each key that the plan names as the switch of a phase is one, and the reason is then that key.
TEST(CostModel, KeysSwitchTheirPhasesOff) {
  const auto off = [](const char* phase, const Overrides& overrides) {
    return costs_of(coupling::small_scene(overrides)).at(phase).off;
  };
  EXPECT_EQ(off("indicator", {}), "the viscosity ratio of every vesicle is 1");
  EXPECT_EQ(off("fluid_viscous", {}), "the viscosity ratio of every vesicle is 1");
  EXPECT_EQ(off("fluid_convection", {"fluid.inertia=none"}), "fluid.inertia = \"none\"");
  EXPECT_EQ(off("fluid_projection", {"fluid.inertia=none"}), "fluid.inertia = \"none\": part of the Stokes solve");
  EXPECT_EQ(off("thickness_correction", {}), "coupling.thickness_correction = false");
  EXPECT_EQ(off("redistribution", {"mesh.redistribute=never"}), "mesh.redistribute = \"never\"");
  EXPECT_EQ(off("adaptation", {}), "time.adaptive = false");
  EXPECT_EQ(off("external_forces", {}), "no gravity on different densities, and repulsion.range = 0");
  for (const std::string file : {"vesicle", "fluid", "checkpoint"}) {
    const std::string key = "output." + file + "_every", phase = "output_" + file;
    EXPECT_EQ(off(phase.c_str(), {key + "=0"}), key + " = 0");
    EXPECT_EQ(costs_of(coupling::small_scene()).at(phase).key, key + " = 0");
  }
}

TEST(CostModel, SaysWhatIsRough) {
  const auto rough = [](const Overrides& overrides, const char* phase) {
    return costs_of(coupling::small_scene(overrides)).at(phase).rough;
  };
  EXPECT_FALSE(rough({}, "fluid_momentum"));
  EXPECT_TRUE(rough({"fluid.inertia=none"}, "fluid_momentum"));
  EXPECT_TRUE(rough({"fluid.velocity_solver=pcg"}, "fluid_momentum"));
  EXPECT_FALSE(rough({"fluid.precision=mixed"}, "fluid_momentum"));
  EXPECT_TRUE(rough({"fluid.pressure_solver=cholmod"}, "fluid_projection"));
  EXPECT_TRUE(rough({"fluid.viscosity_ratio=5", "fluid.viscous_treatment=implicit"}, "fluid_momentum"));
  const std::string plan = describe_plan(coupling::small_scene({"fluid.inertia=none"}), 1);
  EXPECT_NE(plan.find("ms per step, rough"), std::string::npos) << plan;
}

// Sweeps over the grid take a time per cell, transforms one per cell and bit of the cells along an axis.
TEST(CostModel, FluidGrowsWithTheCells) {
  const Scene small = benchmark_scene(32, 24, 20.0);
  Scene large = benchmark_scene(64, 24, 20.0), flat = small;
  flat.domain.cells = {64, 64, 8};
  for (const char* phase : {"fluid_convection", "fluid_viscous"}) {
    EXPECT_NEAR(cost(large, phase) / cost(small, phase), 8.0, 1e-12) << phase;
    EXPECT_NEAR(cost(flat, phase) / cost(small, phase), 1.0, 1e-12) << phase;
  }
  for (const char* phase : {"fluid_momentum", "fluid_projection", "indicator"}) {
    EXPECT_NEAR(cost(large, phase) / cost(small, phase), 8.0 * 6.0 / 5.0, 1e-12) << phase;
    EXPECT_NEAR(cost(flat, phase) / cost(small, phase), 1.0, 1e-12) << phase;
  }
}

// The coupled solve is a solve of the whole velocity, and its iterations grow with the root of the contrast.
TEST(CostModel, CoupledSolvesGrowWithTheRootOfTheContrast) {
  const auto coupled = [](double ratio) {
    Scene scene = benchmark_scene(32, 24, ratio);
    scene.fluid.viscous_treatment = fluid::ViscousTreatment::implicit;
    return cost(scene, "fluid_momentum");
  };
  EXPECT_NEAR(coupled(20.0) / coupled(5.0), 2.0, 1e-12);
  EXPECT_NEAR(coupled(1.0 / 5.0) / coupled(5.0), 1.0, 1e-12);
  EXPECT_GT(coupled(5.0), 10.0 * cost(benchmark_scene(32, 24, 5.0), "fluid_momentum"));
}

// Of L latitudes a membrane has 2 L^2 markers and Legendre transforms of L^3 operations: a L^2 + b L^3, with a, b > 0.
// What is done at each marker alone has b = 0.
TEST(CostModel, MembranesGrowWithTheirMarkersAndTransforms) {
  const auto per_marker = [](int latitudes, const char* phase) {
    Scene scene = benchmark_scene(64, latitudes, 1.0);
    scene.coupling.thickness_correction = true;
    return cost(scene, phase) / (latitudes * latitudes);
  };
  for (const char* phase : {"membrane", "mesh"}) {
    const double a = 2.0 * per_marker(16, phase) - per_marker(32, phase);
    EXPECT_GT(a, 0.0) << phase;
    EXPECT_GT(per_marker(32, phase), 1.1 * per_marker(16, phase)) << phase;
    EXPECT_NEAR(per_marker(64, phase) - a, 4.0 * (per_marker(16, phase) - a), 1e-12 * a) << phase;
  }
  for (const char* phase : {"interpolate", "thickness_correction", "redistribution"})
    EXPECT_NEAR(per_marker(64, phase) / per_marker(16, phase), 1.0, 1e-12) << phase;
}

// Nothing is shared between membranes, and the fluid does not see how many there are.
TEST(CostModel, TwoMembranesCostTwiceOne) {
  const Scene one = benchmark_scene(64, 32, 20.0);
  Scene two = one;
  two.vesicles.push_back(two.vesicles.front());
  for (const char* phase : {"membrane", "spread", "interpolate", "mesh"})
    EXPECT_NEAR(cost(two, phase) / cost(one, phase), 2.0, 1e-12) << phase;
  for (const char* phase : {"fluid_convection", "fluid_momentum", "fluid_projection", "indicator"})
    EXPECT_EQ(cost(two, phase), cost(one, phase)) << phase;
}

// Spreading clears the box around a membrane: some cells more for each marker, fewer where the grid is coarser, and
// markers besides.
TEST(CostModel, SpreadingGrowsWithMarkersAndWithTheCellsAroundThem) {
  const auto spread = [](int cells, int latitudes) { return cost(benchmark_scene(cells, latitudes, 1.0), "spread"); };
  EXPECT_GT(spread(128, 32), spread(64, 32));
  EXPECT_LT(spread(128, 32), 8.0 * spread(64, 32));
  EXPECT_NEAR(spread(64, 64) - spread(64, 32), 4.0 * (spread(64, 32) - spread(64, 16)), 1e-12 * spread(64, 64));
}

TEST(CostModel, SlowerSettingsCostMore) {
  const auto of = [](const char* phase, const Overrides& overrides) {
    return cost(coupling::small_scene(overrides), phase);
  };
  EXPECT_GT(of("fluid_momentum", {}), of("fluid_momentum", {"fluid.precision=mixed"}));
  EXPECT_EQ(of("fluid_projection", {}), of("fluid_projection", {"fluid.precision=mixed"}));
  for (const char* solver : {"pcg", "cholmod"}) {
    EXPECT_GT(of("fluid_momentum", {std::string("fluid.velocity_solver=") + solver}), of("fluid_momentum", {}));
    EXPECT_GT(of("fluid_projection", {std::string("fluid.pressure_solver=") + solver}), of("fluid_projection", {}));
  }
  EXPECT_GT(of("fluid_momentum", {"fluid.inertia=none"}), 5.0 * of("fluid_momentum", {}));
  const auto moved_by = [](coupling::MarkerMotion markers) {
    Scene scene = coupling::small_scene();
    scene.time.markers = markers;
    return costs_of(scene);
  };
  EXPECT_GT(moved_by(coupling::MarkerMotion::arkode).at("interpolate").seconds, 2.0 * of("interpolate", {}));
  EXPECT_GT(moved_by(coupling::MarkerMotion::implicit).at("membrane").seconds,
            2.0 * of("membrane", {"time.markers=shape_following"}));
}

// What is written twice as often costs twice as much, and nothing is written more than once in a step.
TEST(CostModel, OutputCostsWhatItsIntervalSays) {
  const auto seconds = [](const char* every) {
    return cost(coupling::small_scene({std::string("output.checkpoint_every=") + every}), "output_checkpoint");
  };
  EXPECT_NEAR(seconds("0.05") / seconds("0.1"), 2.0, 1e-9);
  EXPECT_NEAR(seconds("1e-6") / seconds("1/96"), 1.0, 1e-9);
}

}  // namespace
}  // namespace vesiflow::run::cost_model_test
