// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/cost_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::run {
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

// Milliseconds per step of shape_following with one thread, by OMP_WAIT_POLICY=passive bench/step --json on a machine with
// nothing else to do (2.6 GHz, AVX2): what the constants were fitted to.
TEST(CostModel, IsWithinAFactorOfTwoOfWhatWasMeasured) {
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
  EXPECT_TRUE(rough({"fluid.pressure_solver=cholmod"}, "fluid_projection"));
  EXPECT_TRUE(rough({"fluid.viscosity_ratio=5", "fluid.viscous_treatment=implicit"}, "fluid_momentum"));
  const std::string plan = describe_plan(coupling::small_scene({"fluid.inertia=none"}), 1);
  EXPECT_NE(plan.find("ms per step, rough"), std::string::npos) << plan;
}

// Twice as often, twice the share, nearly: output is a small part here.
TEST(CostModel, OutputCostsWhatItsIntervalSays) {
  const auto share = [](const char* every) {
    return costs_of(coupling::small_scene({std::string("output.checkpoint_every=") + every}))
        .at("output_checkpoint")
        .seconds;
  };
  EXPECT_NEAR(share("0.05") / share("0.1"), 2.0, 1e-9);
  EXPECT_NEAR(share("1e-6") * 48, share("1/96") * 48, 1e-12);  // no more than once in a step
}

}  // namespace
}  // namespace vesiflow::run
