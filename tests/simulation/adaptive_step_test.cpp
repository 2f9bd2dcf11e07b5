// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "coupling/errors.h"
#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::adaptive_step_test {
namespace {

const Overrides adaptive{"time.adaptive=true", "time.end=0.5"};

Overrides adaptive_with(std::initializer_list<const char*> more) {
  Overrides overrides = adaptive;
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

std::vector<double> steps_to_end(SceneSimulation& simulation) {
  std::vector<double> lengths;
  while (!simulation.finished()) {
    simulation.step();
    lengths.push_back(simulation.time_step());
  }
  return lengths;
}

TEST(AdaptiveStep, EndsOnTimeAndWithinItsLimits) {
  SceneSimulation simulation(small_scene(adaptive_with({"time.largest_step=0.02"})));
  const std::vector<double> lengths = steps_to_end(simulation);
  EXPECT_DOUBLE_EQ(simulation.time(), 0.5);
  EXPECT_EQ(static_cast<std::size_t>(simulation.steps()), lengths.size());
  EXPECT_LE(*std::ranges::max_element(lengths), 0.02);
  for (std::size_t k = 1; k < lengths.size(); ++k) EXPECT_LE(lengths[k], 1.5 * lengths[k - 1] * (1 + 1e-12));
}

// The error that a step of a scheme of first order adds goes with the square of its length: a sixteenth of the tolerance, four
// times the steps, and a quarter of the error at the end.
TEST(AdaptiveStep, StepsAndErrorFollowTheTolerance) {
  const auto shape_of = [](const Overrides& overrides, long& steps) {
    SceneSimulation simulation(small_scene(overrides));
    while (!simulation.finished()) simulation.step();
    steps = simulation.steps();
    return simulation.measure().at(0);
  };
  // Soft, so that no limit of stability has a say; and no other error either.
  long coarse_steps = 0, fine_steps = 0, exact_steps = 0;
  const auto coarse =
      shape_of(adaptive_with({"membrane.g=0.2", "time.tolerance=6.4e-5", "limits.area_error=1", "time.step=1/96"}),
               coarse_steps);
  const auto fine = shape_of(
      adaptive_with({"membrane.g=0.2", "time.tolerance=4e-6", "limits.area_error=1", "time.step=1/96"}), fine_steps);
  const auto exact = shape_of({"membrane.g=0.0125", "time.step=1/1536"}, exact_steps);
  EXPECT_NEAR(static_cast<double>(fine_steps) / static_cast<double>(coarse_steps), 4.0, 1.0);
  const double coarse_error = std::abs(coarse.inclination_angle - exact.inclination_angle);
  const double fine_error = std::abs(fine.inclination_angle - exact.inclination_angle);
  EXPECT_LT(fine_error, 4e-6 * static_cast<double>(fine_steps));  // all errors alike
  EXPECT_NEAR(std::log2(coarse_error / fine_error), 2.0, 0.7);
}

// A first step far beyond what the errors allow is taken back, and the run is as if it had not been tried.
TEST(AdaptiveStep, RefusedStepsLeaveNoTrace) {
  SceneSimulation tried(
      small_scene(adaptive_with({"time.tolerance=1e-7", "time.step=0.03", "limits.area_error=2e-4"})));
  tried.step();
  EXPECT_GT(tried.rejected_steps(), 0);
  SceneSimulation direct(
      small_scene(adaptive_with({"time.tolerance=1e-7", "time.step=0.03", "limits.area_error=2e-4"})));
  SimulationState state = direct.state();
  state.step_control[0] = tried.time_step();
  direct.restore(state);
  direct.step();
  EXPECT_EQ(direct.rejected_steps(), 0);
  EXPECT_EQ(direct.time(), tried.time());
  EXPECT_TRUE((direct.membrane(0).positions() == tried.membrane(0).positions()).all());
  EXPECT_TRUE((direct.membrane(0).target_areas() == tried.membrane(0).target_areas()).all());
  const auto& u = direct.fluid().velocity().x;
  EXPECT_TRUE(std::equal(u.data(), u.data() + u.size(), tried.fluid().velocity().x.data()));
}

Scene with_contrast(const Overrides& overrides) {
  Overrides all{"fluid.viscosity_ratio=5"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return small_scene(all);
}

// The same where the fluid's viscosity follows the vesicle, in every treatment of it, and where vesicles of their own
// properties sink and repel each other in a periodic box: the trial step is made of the state it starts from and nothing else.
TEST(AdaptiveStep, RefusedStepsLeaveNoTraceInViscosityAndExternalForces) {
  const auto compare = [](Scene (*make_scene)(const Overrides&), std::initializer_list<const char*> more) {
    Overrides overrides{"time.adaptive=true", "time.tolerance=1e-7", "time.step=0.03", "limits.area_error=1e-4"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const Scene scene = make_scene(overrides);
    SceneSimulation tried(scene), direct(scene);
    for (int step = 0; step < 2; ++step) {
      const long rejected = tried.rejected_steps();
      SimulationState state = tried.state();
      tried.step();
      EXPECT_GT(tried.rejected_steps() - rejected, 0) << step;
      state.step_control[0] = tried.time_step();
      direct.restore(state);
      direct.step();
      EXPECT_EQ(direct.rejected_steps(), 0) << step;
      EXPECT_EQ(direct.time(), tried.time());
      for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
        EXPECT_TRUE((direct.membrane(i).positions() == tried.membrane(i).positions()).all()) << step;
      const auto& u = direct.fluid().velocity().x;
      EXPECT_TRUE(std::equal(u.data(), u.data() + u.size(), tried.fluid().velocity().x.data())) << step;
      if (const auto* mu = direct.viscosity()) {
        EXPECT_TRUE(std::equal(mu->data(), mu->data() + mu->size(), tried.viscosity()->data())) << step;
      }
      // The next trial is to be refused too.
      state = tried.state();
      state.step_control[0] = 0.03;
      tried.restore(state);
    }
  };
  for (const char* treatment : {"explicit", "extrapolated", "implicit"})
    compare(with_contrast, {(std::string("fluid.viscous_treatment=") + treatment).c_str()});
  compare(with_contrast, {"fluid.inertia=none"});
  compare(three_vesicles, {});
}

Overrides following_with(std::initializer_list<const char*> more) {
  Overrides all{"time.markers=shape_following", "time.adaptive=true",      "domain.cells=[24, 16, 16]",
                "vesicles.0.latitudes=12",      "vesicles.1.latitudes=14", "vesicles.2.latitudes=10",
                "mesh.tangential_degrees=8"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// The error of shape_following is known from the fourth step on, so that is one to be refused: far too long. What it has made
// of histories, corrections owed to the fluid, strains and velocities of sharp membranes must be gone.
TEST(AdaptiveStep, RefusedStepsOfShapeFollowingLeaveNoTrace) {
  for (const auto& [ratio, method, inertia] :
       {std::array{"vesicles.0.viscosity_ratio=1", "coupling.method=delta", "fluid.inertia=full"},
        std::array{"vesicles.0.viscosity_ratio=5", "coupling.method=delta", "fluid.inertia=full"},
        std::array{"vesicles.0.viscosity_ratio=5", "coupling.method=sharp", "fluid.inertia=none"}}) {
    const Scene scene = three_vesicles(
        following_with({"time.step=1/96", "time.tolerance=1e-6", "time.largest_step=0.08", ratio, method, inertia}));
    SceneSimulation tried(scene), direct(scene);
    for (int k = 0; k < 5; ++k) tried.step();
    for (int k = 0; k < 3; ++k) {
      SimulationState state = tried.state();
      state.step_control[0] = 0.04;
      tried.restore(state);
      const long rejected = tried.rejected_steps();
      tried.step();
      ASSERT_GT(tried.rejected_steps(), rejected) << k;
      state.step_control[0] = tried.time_step();
      direct.restore(state);
      direct.step();
      EXPECT_EQ(direct.rejected_steps(), 0) << k;
      const SimulationState a = tried.state(), b = direct.state();
      EXPECT_EQ(a.clock.time, b.clock.time);
      for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
        EXPECT_TRUE((a.vesicles[i].membrane.positions == b.vesicles[i].membrane.positions).all()) << k;
        EXPECT_TRUE((a.vesicles[i].membrane.target_areas == b.vesicles[i].membrane.target_areas).all()) << k;
        EXPECT_EQ(a.vesicles[i].motion_history, b.vesicles[i].motion_history) << k;
        EXPECT_EQ(a.vesicles[i].interface_velocity.rows(), b.vesicles[i].interface_velocity.rows()) << k;
        EXPECT_TRUE((a.vesicles[i].interface_velocity == b.vesicles[i].interface_velocity).all()) << k;
      }
      const auto same = [](const auto& f, const auto& g) {
        return std::equal(f.data(), f.data() + f.size(), g.data());
      };
      EXPECT_TRUE(same(a.velocity.x, b.velocity.x) && same(a.velocity.z, b.velocity.z)) << k;
      EXPECT_TRUE(same(a.pressure, b.pressure)) << k;
    }
  }
}

TEST(AdaptiveStep, ShapeFollowingStopsAtTheSmallestStepAndNamesTheCause) {
  const auto stop_of = [](std::initializer_list<const char*> more) -> std::string {
    SceneSimulation simulation(three_vesicles(following_with(more)));
    try {
      for (int k = 0; k < 20; ++k) simulation.step();
    } catch (const SimulationStopped& stopped) {
      const SimulationState state = simulation.state();
      EXPECT_EQ(state.clock.time, simulation.time());
      return stopped.what();
    }
    return "went on";
  };
  const std::string by_position = stop_of({"time.tolerance=1e-12", "time.smallest_step=0.001", "time.step=0.004"});
  EXPECT_NE(by_position.find("time.smallest_step = 0.001"), std::string::npos) << by_position;
  EXPECT_NE(by_position.find("position error"), std::string::npos) << by_position;
  const std::string by_limit = stop_of({"limits.local_area_error=1e-9", "time.smallest_step=0.001", "time.step=0.004"});
  EXPECT_NE(by_limit.find("time.smallest_step = 0.001"), std::string::npos) << by_limit;
  EXPECT_NE(by_limit.find("local area error"), std::string::npos) << by_limit;
}

// Also a step that cannot be made at all leaves the viscosity of the last one that was.
TEST(AdaptiveStep, StopsWithTheViscosityOfTheLastStep) {
  SceneSimulation simulation(with_contrast(adaptive_with({"time.tolerance=1e-9", "time.smallest_step=0.001"})));
  simulation.step();
  const fluid::Field<fluid::Cell> before = simulation.viscosity()->clone();
  const auto go_on = [&] {
    for (int k = 0; k < 3; ++k) simulation.step();
  };
  EXPECT_THROW(go_on(), SimulationStopped);
  EXPECT_TRUE(std::equal(before.data(), before.data() + before.size(), simulation.viscosity()->data()));
}

// time.step is at g = 15, twice what is stable: the first step is shortened, the others find their length by the error, which
// the instability of the tension shows in.
TEST(AdaptiveStep, FindsAStableStep) {
  SceneSimulation simulation(small_scene(adaptive_with({"membrane.g=15", "time.step=1/96", "time.end=1"})));
  while (!simulation.finished()) simulation.step();
  const vesicle::Diagnostics d = simulation.measure().at(0);
  EXPECT_LT(d.max_local_area_error, 0.02);
  EXPECT_LT(simulation.time_step() * 1440 / (4 * 0.25), 9.0);
}

TEST(AdaptiveStep, StopsAtTheSmallestStepInTheStateBeforeIt) {
  SceneSimulation simulation(small_scene(adaptive_with({"time.tolerance=1e-9", "time.smallest_step=0.001"})));
  simulation.step();  // the first, whose error is not known
  const double time = simulation.time();
  const vesicle::VectorField positions = simulation.membrane(0).positions();
  try {
    for (int k = 0; k < 3; ++k) simulation.step();
    FAIL() << "no step can meet this tolerance";
  } catch (const SimulationStopped& stopped) {
    EXPECT_NE(std::string(stopped.what()).find("time.smallest_step = 0.001"), std::string::npos) << stopped.what();
    EXPECT_NE(std::string(stopped.what()).find("position error"), std::string::npos) << stopped.what();
  }
  EXPECT_EQ(simulation.time(), time);
  EXPECT_TRUE((simulation.membrane(0).positions() == positions).all());
}

TEST(AdaptiveStep, LookingAtItDoesNotChangeIt) {
  SceneSimulation watched(small_scene(adaptive)), alone(small_scene(adaptive));
  for (int i = 0; i < 6; ++i) {
    watched.step();
    watched.measure();
    alone.step();
  }
  EXPECT_EQ(watched.time(), alone.time());
  EXPECT_TRUE((watched.membrane(0).positions() == alone.membrane(0).positions()).all());
}

TEST(AdaptiveStep, RefusesImpossibleLimits) {
  EXPECT_THROW(small_scene(adaptive_with({"time.smallest_step=0.1"})), SceneError);
  EXPECT_THROW(small_scene(adaptive_with({"time.largest_step=0.001"})), SceneError);
  EXPECT_THROW(small_scene(adaptive_with({"time.largest_step=0.3"})), SceneError);
  EXPECT_THROW(small_scene({"time.adaptive=1"}), SceneError);
}

}  // namespace
}  // namespace vesiflow::coupling::adaptive_step_test
