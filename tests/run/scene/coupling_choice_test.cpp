// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Which coupling.method a scene has that does not name one.
#include "scene/coupling_choice.h"

#include <gtest/gtest.h>

#include "run/plan.h"
#include "run/scene.h"

namespace vesiflow::run::coupling_choice_test {
namespace {

using coupling::CouplingMethod;

/// R/h = 8 between two walls.
Scene scene(const Overrides& overrides = {}) {
  return parse_scene(R"(
[domain]
lower = [-2, -2, -2]
upper = [2, 2, 2]
cells = 32
periodic = [true, true, false]
[time]
step = "1/24"
end = 1
[[vesicles]]
shape = "prolate"
reduced_volume = 0.95
)",
                     "scene", overrides);
}

void expect_delta(const Overrides& overrides, const std::string& reason) {
  const Scene chosen = scene(overrides);
  EXPECT_EQ(chosen.coupling.method, CouplingMethod::delta) << reason;
  EXPECT_NE(why_delta(chosen).find(reason), std::string::npos) << why_delta(chosen);
  EXPECT_NE(describe_plan(chosen, 1).find("delta: " + why_delta(chosen)), std::string::npos);
}

TEST(CouplingChoice, IsSharpWhereThatCanBeComputed) {
  for (const Overrides& overrides : {Overrides{},
                                     {"fluid.viscosity_ratio=5"},
                                     {"fluid.reynolds_number=1"},
                                     {"time.markers=implicit"},
                                     {"fluid.viscosity_ratio=0.05"},
                                     {"fluid.viscosity_ratio=0.05", "fluid.inertia=none"}}) {
    const Scene chosen = scene(overrides);
    EXPECT_EQ(chosen.coupling.method, CouplingMethod::sharp) << why_delta(chosen);
    EXPECT_NE(describe_plan(chosen, 1).find("sharp: its error is of second order"), std::string::npos);
  }
}

TEST(CouplingChoice, SaysWhyItIsDelta) {
  expect_delta({"method.preset=paper", "membrane.sigma0=10"}, "it is the paper's");
  expect_delta({"time.markers=euler", "membrane.sigma0=10"}, "\"euler\" knows no sharp membranes");
  expect_delta({"coupling.thickness_correction=true"}, "the cheapest way");
  expect_delta({"coupling.kernel=bspline43"}, "nearer to walls");
  expect_delta({"domain.cells=12"}, "fewer than 4 cells per radius");
  const auto slender_on = [](const char* cells) {
    return Overrides{"domain.lower=[-3, -3, -3]", "domain.upper=[3, 3, 3]", "vesicles.0.reduced_volume=0.7", cells};
  };
  expect_delta(slender_on("domain.cells=42"), "tips and rims");
  EXPECT_EQ(scene(slender_on("domain.cells=48")).coupling.method, CouplingMethod::sharp);
  expect_delta({"fluid.viscosity_ratio=0.1", "fluid.reynolds_number=0.1"}, "ratio 0.1 blow up");
  expect_delta({"fluid.viscosity_ratio=0.3", "fluid.reynolds_number=2"}, "ratio 0.3 blow up");
  const auto fine = [](const char* cells, const char* reynolds_number) {
    return Overrides{"domain.lower=[-3, -3, -3]", "domain.upper=[3, 3, 3]", cells, reynolds_number};
  };
  expect_delta(fine("domain.cells=72", "fluid.reynolds_number=9"), "more than 8 cells per radius");
  EXPECT_EQ(scene(fine("domain.cells=72", "fluid.reynolds_number=5")).coupling.method, CouplingMethod::sharp);
  EXPECT_EQ(scene(fine("domain.cells=48", "fluid.reynolds_number=9")).coupling.method, CouplingMethod::sharp);
}

TEST(CouplingChoice, LeavesWhatIsAskedFor) {
  EXPECT_EQ(scene({"coupling.method=delta"}).coupling.method, CouplingMethod::delta);
  EXPECT_NE(describe_plan(scene({"coupling.method=delta"}), 1).find("delta, as asked for"), std::string::npos);
  const Scene coarse = scene({"coupling.method=sharp", "domain.cells=12"});
  EXPECT_EQ(coarse.coupling.method, CouplingMethod::sharp);
  EXPECT_NE(describe_plan(coarse, 1).find("sharp, as asked for, though"), std::string::npos);
}

TEST(CouplingChoice, IsWrittenWithTheScene) {
  const std::string text = to_toml(scene());
  EXPECT_NE(text.find("method = \"sharp\""), std::string::npos);
  EXPECT_EQ(parse_scene(text, "written").coupling.method, CouplingMethod::sharp);
}

}  // namespace
}  // namespace vesiflow::run::coupling_choice_test
