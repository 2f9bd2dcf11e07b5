// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Starts far from rest, whose first steps are taken in parts.
#include "motion/start_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::start_control_test {
namespace {

/// A deflated prolate across the flow, of which bending makes another shape within a step of 1/24 when the membrane is stiff.
Scene deflated(double capillary_number, const Overrides& more = {}) {
  Overrides overrides{"time.markers=shape_following", "time.step=1/24",       "time.end=0.5",
                      "domain.lower=[-4,-4,-4]",      "domain.upper=[4,4,4]", "domain.cells=32"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scene scene = small_scene(overrides);
  scene.membrane.capillary_number = capillary_number;
  scene.membrane.sigma0 = 600;
  scene.vesicles[0].reduced_volume = 0.7;
  scene.vesicles[0].rotation_deg = 0;
  return scene;
}

// Whole steps stopped at t = 0.33 and less (h = R/5.3 and R/8).
TEST(StartControl, StiffStartEndsAndItsStepsAreWhereTheyWouldBe) {
  const Scene scene = deflated(0.05);
  SceneSimulation simulation(scene);
  for (int n = 1; n <= 12; ++n) {
    const double before = simulation.time();
    simulation.step();
    EXPECT_EQ(simulation.steps(), n);
    EXPECT_EQ(simulation.time(), before + scene.time.step);  // to the last bit
  }
  EXPECT_TRUE(simulation.finished());
  EXPECT_GT(simulation.start_parts(), 12);
}

TEST(StartControl, StartThatIsContinuedIsTheSame) {
  for (const char* markers : {"time.markers=shape_following", "time.markers=implicit"}) {
    const Scene scene = deflated(0.1, {markers});
    SceneSimulation whole(scene), continued(scene);
    whole.step();
    ASSERT_GT(whole.start_parts(), 1) << markers;
    continued.restore(whole.state());
    for (int n = 0; n < 3; ++n) {
      whole.step();
      continued.step();
    }
    EXPECT_GT(whole.start_parts(), 12) << markers;
    EXPECT_EQ(continued.start_parts(), whole.start_parts()) << markers;
    EXPECT_EQ(continued.steps(), whole.steps()) << markers;
    EXPECT_EQ(continued.time(), whole.time()) << markers;
    EXPECT_TRUE((continued.membrane(0).positions() == whole.membrane(0).positions()).all()) << markers;
  }
}

TEST(StartControl, StartNearRestIsWhole) {
  SceneSimulation simulation(deflated(5.0));
  simulation.step();
  EXPECT_EQ(simulation.start_parts(), 0);
  EXPECT_TRUE(simulation.state().step_control.empty());
}

// Halves until a part is short enough, twice as long after eight calm ones where that fits, and done with a whole step.
TEST(StartControl, PartsFillSteps) {
  StartControl control;
  const double step = 1.0 / 24.0;
  double time = 0.0;
  long steps = 0;
  double longest = 0.0, last = 0.0;
  while (control.watches(steps)) {
    ASSERT_LT(steps, 100);
    const double end = time + step;
    double dt = 0.0;
    do {
      while (dt = control.next(time, end, step), !control.accepts(steps == 0 ? 10.0 * dt : 0.0, steps))
        control.shorten();
      if (last > 0.0) {
        EXPECT_LT(dt, 2.0001 * last);
      }
      last = dt;
      time += dt;
      longest = std::max(longest, dt);
    } while (!control.advance(0.0, steps));
    ++steps;
    EXPECT_EQ(time, end);
  }
  EXPECT_NEAR(longest, step / 2, 1e-15);  // parts that end with a step have its round-off
}

// What is fast for longer than a start ends in whole steps all the same.
TEST(StartControl, StartsEnd) {
  StartControl control;
  EXPECT_FALSE(control.accepts(1.0, 0));
  control.shorten();
  long steps = 0;
  for (; control.watches(steps); ++steps) {
    ASSERT_LT(steps, 100);
    while (!control.advance(0.04, steps)) {
    }
  }
  EXPECT_GT(steps, 48);
}

TEST(StartControl, RefusesWhatIsNoState) {
  StartControl control;
  EXPECT_NO_THROW(control.restore({}));
  for (const std::vector<double>& state :
       {std::vector<double>{1.0}, {11.0, 0.0, 1.0}, {0.5, 0.0, 1.0}, {1.0, -1.0, 1.0}})
    EXPECT_THROW(control.restore(state), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::start_control_test
