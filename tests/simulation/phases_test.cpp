// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What is switched off is never entered and allocates nothing.
#include "coupling/phases.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "coupling/simulation.h"
#include "plan/cost_model.h"
#include "run/plan.h"
#include "run/run.h"
#include "support/allocation_counter.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::phases_test {
namespace {

using run::RunOptions;

struct Switch {
  const char* name;
  Overrides off;
  Overrides on;  // the same part, where the scene of the test does not have it by itself
  std::function<std::int64_t(const SceneSimulation&)> entries;
  bool without_tension = false;
};

// One switch of a scene: the plan calls a phase by its account.
template <class... Accounts>
auto entries_of(Accounts... accounts) {
  return [=](const SceneSimulation& simulation) { return ((simulation.phases().*accounts).entries + ...); };
}

Overrides with(const Overrides& a, const Overrides& b) {
  Overrides all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

const std::vector<Switch>& switches() {
  static const std::vector<Switch> all{
      {"indicator", {}, {"fluid.viscosity_ratio=5"}, entries_of(&Phases::indicator)},
      {"viscous_term", {}, {"fluid.viscosity_ratio=5"}, entries_of(&Phases::fluid_viscous)},
      {"tension", {}, {}, [](const SceneSimulation& s) { return s.part_entries().tension; }, true},
      {"strain", {}, {}, [](const SceneSimulation& s) { return s.part_entries().strain; }, true},
      {"volume",
       {"membrane.volume=none"},
       {},
       [](const SceneSimulation& s) { return s.part_entries().conservation; },
       true},  // which shape_following keeps the area with
      {"convection", {"fluid.inertia=none"}, {}, entries_of(&Phases::fluid_convection)},
      {"projection", {"fluid.inertia=none"}, {}, entries_of(&Phases::fluid_projection)},
      {"redistribution",
       {"mesh.redistribute=never"},
       {"mesh.redistribute=when_needed"},
       entries_of(&Phases::redistribution)},
      {"repulsion", {"repulsion.range=0"}, {"repulsion.range=0.5"}, entries_of(&Phases::external_forces)},
      {"buoyancy",
       {"gravity.acceleration=[0, 0, 0]"},
       {"gravity.acceleration=[0, 0, -1]", "vesicles.0.density_difference=1"},
       entries_of(&Phases::external_forces)},
      {"adaptive_steps", {"time.adaptive=false"}, {"time.adaptive=true"}, entries_of(&Phases::adaptation)},
      {"thickness_correction",
       {"coupling.thickness_correction=false"},
       {"coupling.thickness_correction=true", "time.markers=shape_following"},
       entries_of(&Phases::thickness_correction)},
  };
  return all;
}

class SwitchedOff : public testing::TestWithParam<std::size_t> {
 protected:
  const Switch& part() const { return switches().at(GetParam()); }
  static Overrides small(const char* markers) {
    return {"domain.cells=16", "mesh.latitudes=12", "mesh.tangential_degrees=8",
            std::string("time.markers=") + markers};
  }
};

TEST_P(SwitchedOff, IsNeverEnteredAndAllocatesNothing) {
  for (const char* markers : {"euler", "shape_following"}) {
    Scene scene = small_scene(with(small(markers), part().off));
    if (part().without_tension) {
      scene.membrane.sigma0 = 0.0;
      scene.g.reset();
    }
    SceneSimulation simulation(scene);
    constexpr int warm_up = 3, steps = 3;
    for (int k = 0; k < warm_up; ++k) simulation.step();
    // The first step may have to be taken back, like an adaptive one (start_control.h).
    const bool watches_start = part().name == std::string("adaptive_steps") && scene.follows_shape();
    EXPECT_EQ(part().entries(simulation), watches_start ? 1 : 0) << markers;
    const long before = vesiflow::test::allocation_count(), entered = part().entries(simulation);
    for (int k = 0; k < steps; ++k) simulation.step();
    EXPECT_EQ(vesiflow::test::allocation_count() - before, 0) << markers;
    EXPECT_EQ(part().entries(simulation) - entered, 0) << markers;
  }
}

// The counters count: switched on, the same phase is entered.
TEST_P(SwitchedOff, IsEnteredOnceSwitchedOn) {
  SceneSimulation simulation(small_scene(with(small("euler"), part().on)));
  for (int k = 0; k < 16; ++k) simulation.step();
  EXPECT_GT(part().entries(simulation), 0);
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  return switches().at(info.param).name;
}
INSTANTIATE_TEST_SUITE_P(Parts, SwitchedOff, testing::Range<std::size_t>(0, switches().size()), name_of);

// Of every phase that a plain scene has off, and all others once in each step.
TEST(Phases, EveryStepEntersWhatIsOnAndNothingElse) {
  SceneSimulation simulation(small_scene({"domain.cells=16", "mesh.latitudes=12", "mesh.tangential_degrees=8"}));
  for (int k = 0; k < 3; ++k) simulation.step();
  const Phases phases = simulation.phases();
  visit_phases(phases, [](const std::string& name, const fluid::PhaseAccount& account) {
    const bool on = name == "membrane" || name == "spread" || name == "fluid_convection" || name == "fluid_momentum" ||
                    name == "fluid_projection" || name == "interpolate" || name == "mesh";
    if (on)
      EXPECT_GE(account.entries, 3) << name;
    else
      EXPECT_EQ(account.entries, 0) << name;
    EXPECT_EQ(account.seconds > 0.0, on) << name;
  });
}

class Output : public testing::Test {
 protected:
  Output()
      : folder_(std::filesystem::temp_directory_path() /
                ("vesiflow_phases_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {}
  ~Output() override { std::filesystem::remove_all(folder_); }

  std::map<std::string, std::int64_t> entries_after_run(const Overrides& overrides) const {
    SceneSimulation simulation(small_scene(with({"domain.cells=16", "mesh.latitudes=12", "mesh.tangential_degrees=8",
                                                 "time.step=1/32", "membrane.g=4", "time.end=0.1"},
                                                overrides)));
    RunOptions options;
    options.directory = folder_;
    options.quiet = true;
    run::run(simulation, options);
    std::ostringstream text;
    text << std::ifstream(folder_ / "summary.json").rdbuf();
    std::istringstream lines(text.str().substr(text.str().find("\"phase_entries\"")));
    std::map<std::string, std::int64_t> entries;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.find('}') == std::string::npos) {
      const std::size_t start = line.find('"') + 1, end = line.find('"', start);
      entries[line.substr(start, end - start)] = std::stol(line.substr(line.find(':') + 1));
    }
    return entries;
  }

  std::filesystem::path folder_;
};

TEST_F(Output, SwitchedOffIsNeverEntered) {
  const auto entries = entries_after_run(
      {"output.diagnostics_every=0", "output.vesicle_every=0", "output.fluid_every=0", "output.checkpoint_every=0"});
  for (const char* phase : {"output_table", "output_vesicle", "output_fluid", "output_checkpoint"})
    EXPECT_EQ(entries.at(phase), 0) << phase;
  EXPECT_EQ(entries.at("diagnostics"), 2);  // of the summaries at the start and at the end, which is being written
}

TEST_F(Output, IsEnteredOnceForEachFile) {
  const auto entries = entries_after_run({"output.diagnostics_every=1/32", "output.vesicle_every=1/16",
                                          "output.fluid_every=1/8", "output.checkpoint_every=1/16"});
  EXPECT_EQ(entries.at("output_table"), 5);       // four steps and the start
  EXPECT_EQ(entries.at("output_vesicle"), 3);     // the start and steps 2 and 4
  EXPECT_EQ(entries.at("output_fluid"), 2);       // the start and the end
  EXPECT_EQ(entries.at("output_checkpoint"), 2);  // steps 2 and 4
}

}  // namespace
}  // namespace vesiflow::coupling::phases_test
