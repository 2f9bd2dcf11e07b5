// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What finds a blow-up before it is not finite, and what a run does about it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "coupling/errors.h"
#include "run/checkpoint.h"
#include "run/run.h"
#include "step/blow_up_guard.h"
#include "step/velocity_noise.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::blow_up_test {
namespace {

using run::RunStatus, run::RunOptions, run::read_checkpoint_scene, run::restore_checkpoint, run::run;

namespace fs = std::filesystem;
using vesicle::VectorField;

// A motion that is smooth in time and a part of marker 1 that changes its sign from step to step.
VectorField velocity_at(double time, int step, double alternating) {
  VectorField velocity(3, 3);
  for (int m = 0; m < 3; ++m) velocity.row(m) << std::cos(time), std::sin(time), 0.25 * m;
  velocity(1, 2) += step % 2 == 0 ? alternating : -alternating;
  return velocity;
}

double noise_of(double dt, double alternating) {
  VelocityNoise noise;
  for (int step = 0; step < 5; ++step) noise.update(velocity_at(step * dt, step, alternating));
  if (alternating > 0.1) {
    EXPECT_EQ(noise.marker(), 1);
  }
  return noise.value();
}

TEST(VelocityNoise, IsTheAmplitudeOfWhatAlternatesAndOfSecondOrderInTheStepForWhatIsSmooth) {
  for (const double dt : {0.1, 0.05, 0.025}) EXPECT_NEAR(noise_of(dt, 0.0), 0.5 * (1.0 - std::cos(dt)), 1e-15);
  EXPECT_NEAR(noise_of(1e-4, 0.3), 0.3, 1e-8);
}

TEST(VelocityNoise, IsNotKnownBeforeThreeSteps) {
  VelocityNoise noise;
  for (int start = 0; start < 2; ++start) {
    for (int step = 0; step < 2; ++step) {
      noise.update(velocity_at(0.1 * step, step, 0.3));
      EXPECT_EQ(noise.value(), 0.0);
    }
    noise.update(velocity_at(0.2, 2, 0.3));
    EXPECT_GT(noise.value(), 0.2);
    noise.restart();
  }
}

TEST(BlowUpGuard, FindsNoiseThatLastsAndSaysWhere) {
  BlowUpGuard guard(small_scene(), 3.0);
  VelocityNoise noise;
  VectorField positions = VectorField::Zero(3, 3);
  positions.row(1) << 0.5, -0.25, 1.25;
  std::string found;
  int step = 0;
  const auto take = [&](double alternating) {
    noise.update(velocity_at(0.0, step++, alternating));
    found = guard.look_at(0, noise, positions);
  };
  for (int i = 0; i < 20; ++i) take(0.4);  // a third of the speed: below the limit of a half
  EXPECT_EQ(found, "");
  EXPECT_FALSE(guard.suspects());
  for (int i = 0; i < 7; ++i) {
    take(3.0);
    EXPECT_EQ(found, "");
  }
  EXPECT_TRUE(guard.suspects());
  for (int i = 0; i < 4; ++i) take(0.0);
  EXPECT_FALSE(guard.suspects());
  for (int i = 0; i < 12; ++i) take(3.0);
  EXPECT_NE(found.find("vesicle 0"), std::string::npos) << found;
  EXPECT_NE(found.find("marker 1, (0.5, -0.25, 1.25)"), std::string::npos) << found;
}

TEST(BlowUpGuard, FindsAFluidFasterThanWallsAndMembranes) {
  const Scene scene = small_scene();
  const fluid::Grid grid = grid_of(scene);
  fluid::FaceVector velocity(grid);
  velocity.x.fill(2.9);
  BlowUpGuard guard(scene, 3.0);
  EXPECT_EQ(guard.look_at(velocity, 8), "");
  velocity.y(4, 5, 6) = -9.1;
  EXPECT_EQ(guard.look_at(velocity, 9), "");  // only every eighth step
  const std::string found = guard.look_at(velocity, 16);
  const fluid::Vector3 x = velocity.y.position(4, 5, 6);
  EXPECT_NE(found.find("along y is 9.1"), std::string::npos) << found;
  EXPECT_NE(found.find(fmt::format("({:.3g}, {:.3g}, {:.3g})", x[0], x[1], x[2])), std::string::npos) << found;
  BlowUpGuard unknown(scene, std::numeric_limits<double>::infinity());
  EXPECT_EQ(unknown.look_at(velocity, 16), "");
}

class BlowUpTest : public testing::Test {
 protected:
  BlowUpTest()
      : folder_(fs::temp_directory_path() / ("vesiflow_blow_up_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~BlowUpTest() override { fs::remove_all(folder_); }

  RunStatus run_scene(const Scene& scene) const {
    SceneSimulation simulation(scene);
    RunOptions options;
    options.directory = folder_;
    options.quiet = true;
    return run(simulation, options);
  }
  nlohmann::json summary() const { return nlohmann::json::parse(std::ifstream(folder_ / "summary.json")); }

  fs::path folder_;
};

// The explicit tension beyond its stability, which no smooth motion is.
const Overrides unstable = {"membrane.g=8.5", "output.checkpoint_every=0.05", "output.vesicle_every=0",
                            "output.fluid_every=0"};

Overrides with(Overrides base, const Overrides& more) {
  base.insert(base.end(), more.begin(), more.end());
  return base;
}

TEST_F(BlowUpTest, IsFoundWhileAllIsFinite) {
  try {
    run_scene(small_scene(with(unstable, {"limits.local_area_error=1000"})));
    FAIL() << "should have stopped";
  } catch (const SimulationStopped& reason) {
    EXPECT_NE(std::string(reason.what()).find("the velocity of the membrane of vesicle 0"), std::string::npos)
        << reason.what();
  }
  const auto numbers = summary();
  EXPECT_EQ(numbers["status"], "stopped");
  EXPECT_TRUE(numbers["vesicles"][0]["area"].is_number());
  EXPECT_GT(numbers["largest_errors"]["velocity_noise"], 0.5);
}

// Noise that is above its limit keeps checkpoints from being written: the last one is of before.
TEST_F(BlowUpTest, LeavesACheckpointOfBefore) {
  const Overrides keys = with(unstable, {"limits.local_area_error=1000", "output.checkpoint_every=0.01"});
  EXPECT_THROW(run_scene(small_scene(keys)), SimulationStopped);
  const Scene scene = small_scene(keys);
  SceneSimulation whole(scene), again(scene);
  restore_checkpoint(folder_ / "checkpoint.h5", again);
  while (whole.steps() < again.steps()) {
    whole.step();
    ASSERT_FALSE(whole.suspects_blow_up() && whole.steps() == again.steps());
  }
  EXPECT_LE(again.steps(), summary()["steps"].get<long>() - 8);
}

TEST_F(BlowUpTest, GoesBackAndTakesHalfTheStep) {
  const Overrides keys = with(unstable, {"limits.on_blowup=reduce_step", "time.end=0.3"});
  EXPECT_EQ(run_scene(small_scene(keys)), RunStatus::completed);
  const auto numbers = summary();
  ASSERT_EQ(numbers["retries"].size(), 1);
  const auto& retry = numbers["retries"][0];
  const double dt = small_scene(keys).time.step;
  EXPECT_EQ(retry["time_step"], dt / 2);
  EXPECT_NEAR(numbers["time"].get<double>(), 0.3, dt / 2 + 1e-12);
  EXPECT_GE(numbers["time"].get<double>(), 0.3 - 1e-9);

  // The same by hand, to the last bit.
  const Scene scene = small_scene(keys);
  SceneSimulation by_hand(scene);
  while (by_hand.steps() < retry["from_step"]) by_hand.step();
  by_hand.set_time_step(dt / 2);
  while (!by_hand.finished()) by_hand.step();
  const Scene written = read_checkpoint_scene(folder_ / "checkpoint.h5");
  EXPECT_EQ(written.time.step, dt / 2);
  SceneSimulation by_run(written);
  restore_checkpoint(folder_ / "checkpoint.h5", by_run);
  EXPECT_EQ(by_run.steps(), by_hand.steps());
  EXPECT_TRUE(by_run.finished());
  EXPECT_TRUE((by_run.membrane(0).positions() == by_hand.membrane(0).positions()).all());

  // Rows of the steps that were taken back are gone.
  std::ifstream table(folder_ / "diagnostics.csv");
  std::string row;
  std::getline(table, row);
  double last = -1.0;
  while (std::getline(table, row)) {
    const double time = std::stod(row.substr(row.find(',') + 1));
    EXPECT_GT(time, last);
    last = time;
  }
}

TEST_F(BlowUpTest, GoesBackNoMoreOftenThanItMay) {
  // No step is short enough for a membrane that may not change at all.
  const Overrides keys =
      with(unstable, {"limits.on_blowup=reduce_step", "limits.local_area_error=1e-9", "limits.retries=2"});
  EXPECT_THROW(run_scene(small_scene(keys)), SimulationStopped);
  const auto retries = summary()["retries"];
  ASSERT_EQ(retries.size(), 2);
  EXPECT_EQ(retries[1]["time_step"].get<double>(), 0.5 * retries[0]["time_step"].get<double>());
  EXPECT_EQ(summary()["status"], "stopped");
}

TEST_F(BlowUpTest, AStableRunHasLittleNoiseAndNoRetries) {
  EXPECT_EQ(run_scene(small_scene({"membrane.g=2", "limits.on_blowup=reduce_step", "time.end=0.3"})),
            RunStatus::completed);
  EXPECT_LT(summary()["largest_errors"]["velocity_noise"], 0.02);
  EXPECT_TRUE(summary()["retries"].empty());
}

TEST_F(BlowUpTest, NeedsCheckpointsAndEqualSteps) {
  EXPECT_THROW(small_scene({"limits.on_blowup=reduce_step", "output.checkpoint_every=0"}), SceneError);
  EXPECT_THROW(small_scene({"limits.on_blowup=reduce_step", "time.adaptive=true"}), SceneError);
}

TEST_F(BlowUpTest, ARunThatIsOutOfTimeLeavesACheckpoint) {
  EXPECT_EQ(run_scene(small_scene({"time.end=1000", "limits.wall_time=0.1"})), RunStatus::out_of_time);
  EXPECT_EQ(run::exit_code::of(RunStatus::out_of_time), 6);
  const auto numbers = summary();
  EXPECT_EQ(numbers["status"], "out of time");
  EXPECT_LT(numbers["steps"], 96000);  // none at all, where a sanitizer makes the start take that long
  SceneSimulation again(small_scene({"time.end=1000"}));
  restore_checkpoint(folder_ / "checkpoint.h5", again);
  EXPECT_EQ(again.steps(), numbers["steps"]);
}

TEST(SetTimeStep, EndsOnTheSameTimeAndRefusesWhatIsNoStep) {
  SceneSimulation simulation(small_scene({"time.end=0.125"}));  // 12 steps of 1/96
  for (int i = 0; i < 5; ++i) simulation.step();
  simulation.set_time_step(1.0 / 192.0);
  EXPECT_EQ(simulation.last_step(), 5 + 14);
  while (!simulation.finished()) simulation.step();
  EXPECT_NEAR(simulation.time(), 0.125, 1e-12);
  EXPECT_THROW(simulation.set_time_step(0.0), std::invalid_argument);
  EXPECT_THROW(simulation.set_time_step(std::nan("")), std::invalid_argument);
  SceneSimulation adaptive(small_scene({"time.adaptive=true"}));
  EXPECT_THROW(adaptive.set_time_step(0.01), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::blow_up_test
