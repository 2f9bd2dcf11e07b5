// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What plans say of membranes without thickness.
#include "plan/sharp_plan.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "plan/cost_model.h"
#include "plan/memory_plan.h"
#include "run/plan.h"
#include "support/small_scene.h"

namespace vesiflow::run::sharp_plan_test {
namespace {

Scene sharp(std::initializer_list<std::string> more) {
  Overrides all{"coupling.method=sharp", "fluid.inertia=none", "time.markers=shape_following"};
  all.insert(all.end(), more);
  return coupling::small_scene(all);
}

// The same scene, coupled by a delta function.
Scene delta(std::initializer_list<std::string> more) {
  Scene scene = sharp(more);
  scene.coupling.method = coupling::CouplingMethod::delta;
  return scene;
}

class PlanText {
 public:
  explicit PlanText(const Scene& scene) : text_(describe_plan(scene, 1)) {}
  void has(const std::string& part) const { EXPECT_NE(text_.find(part), std::string::npos) << part << "\n" << text_; }
  void has_not(const std::string& part) const {
    EXPECT_EQ(text_.find(part), std::string::npos) << part << "\n" << text_;
  }
  void does(const std::string& part) const { has("  + " + part + " "); }
  void skips(const std::string& part, const std::string& why) const {
    std::string line = "  - " + part;
    line.resize(34, ' ');
    has(line + "skipped: " + why);
  }

 private:
  std::string text_;
};

TEST(SharpPlan, SaysWhichMethodAndWhatItSkips) {
  const PlanText equal(sharp({}));
  equal.does("jumps");
  equal.skips("spread, interpolate", "coupling.method = \"sharp\"");
  equal.skips("interface velocity", "the viscosity ratio of every vesicle is 1");
  equal.skips("indicator", "the viscosity ratio of every vesicle is 1");
  equal.skips("thickness correction", "coupling.method = \"sharp\"");
  equal.has("with constant coefficients");

  const PlanText two(sharp({"fluid.viscosity_ratio=5"}));
  two.does("jumps");
  two.does("interface velocity");
  two.has("mu between 1 and 5: about ");
  two.has(" solves with viscosity 1 in a step");
  two.skips("indicator", "coupling.method = \"sharp\"");
  two.skips("variable viscosity", "coupling.method = \"sharp\"");
  two.has("velocity and pressure together, to a tolerance, with constant coefficients");
  two.skips("inertia of phases", "fluid.inertia = \"none\"");
  equal.skips("inertia of phases", "the viscosity ratio of every vesicle is 1");
}

TEST(SharpPlan, OfTwoViscositiesWithInertia) {
  constexpr auto five = "fluid.viscosity_ratio=5", inertia = "fluid.inertia=full", ten = "fluid.reynolds_number=10";
  const PlanText plan(sharp({five, inertia, ten}));
  plan.does("inertia of phases");
  plan.has_not("can blow up at such Reynolds numbers");
  EXPECT_EQ(fluid_solves(sharp({five, inertia, ten})), 3.4);
  PlanText(delta({five, inertia, ten})).skips("inertia of phases", "coupling.method = \"delta\"");
  const auto fluid_memory = [](const char* ratio) { return plan_memory(sharp({ratio, "fluid.inertia=full"})).fluid; };
  EXPECT_GT(fluid_memory(five), 1.5 * fluid_memory("fluid.viscosity_ratio=1"));
  // Its solver has another Reynolds number: three times of convection on the grid.
  EXPECT_GT(fluid_memory("fluid.viscosity_ratio=0.3"), 1.2 * fluid_memory(five));
  const PlanText thin(sharp({"fluid.viscosity_ratio=0.2", "fluid.inertia=full", "fluid.reynolds_number=10"}));
  thin.has("can blow up at such Reynolds numbers");
  PlanText(sharp({"fluid.viscosity_ratio=0.05", "fluid.inertia=full", "fluid.reynolds_number=0.1"}))
      .has("a fluid of ratio 0.05 inside can blow up at such Reynolds numbers: take fluid.reynolds_number <= 0.005");
  PlanText(sharp({"fluid.viscosity_ratio=0.05"})).has_not("blow up at such");
  PlanText(sharp({inertia, ten, "domain.cells=128"})).has("grids with more than 8 cells per radius can blow up");
  PlanText(sharp({inertia, ten, "domain.cells=40"})).has_not("cells per radius can blow up");
  PlanText(sharp({"fluid.viscosity_ratio=0.2", "fluid.inertia=full", "fluid.reynolds_number=1"}))
      .has_not("can blow up at such Reynolds numbers");
}

TEST(SharpPlan, OfDeltaFunctionsSaysSo) {
  for (const char* ratio : {"fluid.viscosity_ratio=1", "fluid.viscosity_ratio=5"}) {
    const PlanText plan(delta({ratio}));
    plan.does("spread, interpolate");
    plan.skips("jumps", "coupling.method = \"delta\"");
    plan.skips("interface velocity", "coupling.method = \"delta\"");
    plan.has_not("recommended region");
    plan.has_not("are mapped");
  }
  PlanText(delta({"fluid.viscosity_ratio=5"})).has_not("with constant coefficients");
}

// h = 6/24 in the small scene: Re h^2/dt = 240.
TEST(SharpPlan, DoesNotWarnOfStepsThatAreShortForTheirInertia) {
  PlanText(sharp({"fluid.inertia=full", "fluid.reynolds_number=10", "time.step=1/384"})).has_not("WARNING");
}

// Limits that were found with delta functions are no warnings here.
TEST(SharpPlan, SaysWhatOfItsRegionIsMapped) {
  const PlanText plan(sharp({}));
  plan.has("are mapped: other limits are those of \"delta\"");
  plan.has("other limits are those of \"delta\"; walls at least 1.5 h off");
  PlanText(sharp({"coupling.kernel=bao6"})).has("walls at least 2.5 h off");
  plan.has("error of the grid               of second order");
  for (const char* cells : {"domain.cells=16", "domain.cells=48"}) {  // across a vesicle, between markers
    PlanText(delta({cells})).has("WARNING");
    PlanText(sharp({cells})).has_not("WARNING");
  }
}

std::map<std::string, PhaseCost> costs_of(const Scene& scene) {
  std::map<std::string, PhaseCost> costs;
  for (const PhaseCost& cost : estimate_costs(scene)) costs[cost.phase] = cost;
  return costs;
}

TEST(SharpPlan, EachPassCostsItsSolveAndItsJumps) {
  EXPECT_EQ(fluid_solves(sharp({})), 1.0);
  EXPECT_EQ(fluid_solves(delta({"fluid.viscosity_ratio=5"})), 1.0);
  const Scene two = sharp({"fluid.viscosity_ratio=5"});
  const double passes = fluid_solves(two);
  EXPECT_GT(passes, 1.0);
  auto once = costs_of(sharp({})), again = costs_of(two), thick = costs_of(delta({}));
  for (const char* phase : {"interpolate", "fluid_momentum"})
    EXPECT_NEAR(again[phase].seconds, passes * once[phase].seconds, 1e-12 * again[phase].seconds) << phase;
  // Points of the grid near the membrane are found once in a step.
  EXPECT_GT(again["spread"].seconds, 1.5 * once["spread"].seconds);
  EXPECT_LT(again["spread"].seconds, 0.7 * passes * once["spread"].seconds);
  for (const char* phase : {"membrane", "mesh", "diagnostics"})
    EXPECT_EQ(again[phase].seconds, thick[phase].seconds) << phase;
  EXPECT_GT(once["spread"].seconds, thick["spread"].seconds);
  EXPECT_EQ(once["fluid_momentum"].seconds, thick["fluid_momentum"].seconds);
  EXPECT_TRUE(once["spread"].rough && once["interpolate"].rough);
  for (const char* phase : {"indicator", "fluid_viscous"}) {
    EXPECT_EQ(again[phase].seconds, 0.0) << phase;
    EXPECT_EQ(again[phase].off, "coupling.method = \"sharp\": mu u is solved for") << phase;
  }
}

// The fluid of a step whose viscous layer is thinner than the vesicle is solved a second time, all but its convection, which needs the
// force that it was solved with.
TEST(SharpPlan, WithInertiaThatMattersTheFluidIsCorrected) {
  constexpr auto inertia = "fluid.inertia=full", one = "fluid.reynolds_number=1";
  const Scene scene = sharp({inertia, one}), slow = sharp({inertia});
  EXPECT_EQ(fluid_solves(scene), 2.0);
  EXPECT_EQ(fluid_solves(slow), 1.0);
  EXPECT_EQ(fluid_solves(delta({inertia, one})), 1.0);
  EXPECT_EQ(fluid_solves(sharp({inertia, one, "time.markers=implicit"})), 1.0);
  PlanText(slow).has("of which the fluid keeps no memory that matters");
  PlanText(scene).has("the fluid is solved a second time");
  PlanText(sharp({})).has_not("the fluid is solved a second time");
  auto sharp_costs = costs_of(scene), delta_costs = costs_of(delta({inertia, one}));
  EXPECT_EQ(sharp_costs["fluid_convection"].seconds, delta_costs["fluid_convection"].seconds);
  for (const char* phase : {"fluid_momentum", "fluid_projection"})
    EXPECT_EQ(sharp_costs[phase].seconds, 2.0 * delta_costs[phase].seconds) << phase;
  const double field = 8.0 * 26.0 * 26.0 * 26.0;  // of 24^3 cells
  EXPECT_NEAR(plan_memory(scene).fluid - plan_memory(slow).fluid, 3.0 * field, 1e-9 * field);
}

// A source of the divergence, a field at the cells, and between two viscosities a velocity; no indicator and no field of viscosity.
TEST(SharpPlan, CountsTheFieldsThatItHas) {
  const auto fluid = [](const Scene& scene) { return plan_memory(scene).fluid; };
  const double field = 8.0 * 26.0 * 26.0 * 26.0;  // of 24^3 cells
  EXPECT_NEAR(fluid(sharp({})) - fluid(delta({})), field, 1e-9 * field);
  EXPECT_NEAR(fluid(sharp({"fluid.viscosity_ratio=5"})) - fluid(sharp({})), 3.0 * field, 1e-9 * field);
  EXPECT_GT(fluid(delta({"fluid.viscosity_ratio=5"})), fluid(sharp({"fluid.viscosity_ratio=5"})));
  EXPECT_GT(sharp_bytes(sharp({"mesh.latitudes=32"})), sharp_bytes(sharp({})));
  const double coarse = sharp_bytes(sharp({})), fine = sharp_bytes(sharp({"domain.cells=96"}));
  EXPECT_NEAR(plan_memory(sharp({})).membranes - plan_memory(delta({})).membranes, coarse, 1e-9 * coarse);
  EXPECT_GT(fine, 8.0 * coarse);  // between squares and cubes of the cells
  EXPECT_LT(fine, 64.0 * coarse);
}

// Peak resident megabytes of `vesicles scenes/tank_treading_coarse.toml` without correction of the thickness, without inertia and output,
// three steps of 1/24: with the delta function at equal viscosities, and sharp.
TEST(SharpPlan, TakesWithinATenthAsMuchMoreMemoryAsWasMeasured) {
  struct Measured {
    int cells, latitudes;
    double ratio, delta, sharp;
  };
  constexpr Measured all[] = {{48, 32, 1.0, 69.9, 75.9},   {48, 32, 5.0, 69.9, 79.2},   {64, 32, 1.0, 115.2, 125.0},
                              {64, 64, 1.0, 157.7, 173.6}, {96, 32, 1.0, 300.9, 324.0}, {96, 32, 5.0, 300.9, 347.8},
                              {128, 64, 1.0, 698.4, 753.8}};
  for (const Measured& m : all) {
    Scene scene;
    scene.fluid.inertia = fluid::Inertia::none;
    scene.domain.cells.fill(m.cells);
    scene.mesh.latitudes = m.latitudes;
    scene.output = {0.0, 0.0, 0.0, 0.0};
    scene.vesicles.resize(1);
    const double delta = plan_memory(scene).total();
    scene.coupling.method = coupling::CouplingMethod::sharp;
    scene.fluid.viscosity_ratio = m.ratio;
    EXPECT_NEAR(1e-6 * (plan_memory(scene).total() - delta) / (m.sharp - m.delta), 1.0, 0.1)
        << m.cells << ", " << m.latitudes << ", " << m.ratio;
  }
}

TEST(SharpPlan, WarnsOfStepsThatAreLongForStiffBending) {
  PlanText(sharp({"membrane.capillary_number=0.1", "time.step=1/24", "membrane.g=2"})).has("take time.step <= 0.02");
  PlanText(sharp({"membrane.capillary_number=0.1", "time.step=1/60", "membrane.g=2"}))
      .has_not("take time.step <= 0.02");
  PlanText(delta({"membrane.capillary_number=0.1", "time.step=1/24", "membrane.g=2"})).has_not("take time.step <=");
}

}  // namespace
}  // namespace vesiflow::run::sharp_plan_test
