// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs that start from the end of another one.
#include "run/start_from.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fluid/operators.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/run.h"
#include "support/small_scene.h"

namespace vesiflow::run::start_from_test {
namespace {

namespace fs = std::filesystem;

// Small enough for a run in every test.
Scene scene_with(Overrides overrides) {
  Overrides all{"domain.cells=20", "mesh.latitudes=12", "mesh.tangential_degrees=10",  "membrane.g=3",
                "time.end=0.125",  "time.step='1/64'",  "time.markers=shape_following"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return coupling::small_scene(all);
}

class StartFrom : public testing::Test {
 protected:
  StartFrom() {
    fs::remove_all(folder_);
    SceneSimulation simulation(scene_with({}));
    run(simulation, {.directory = first_, .quiet = true});
  }
  ~StartFrom() override { fs::remove_all(folder_); }

  // The message of the refusal.
  std::string refusal(const fs::path& run, const Scene& scene) const {
    SceneSimulation simulation(scene);
    try {
      start_from(run, simulation);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  }

  static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("vesiflow_start_" + std::to_string(getpid()));
  const fs::path first_ = folder_ / "first";
};

double largest_difference(const coupling::SimulationState& a, const coupling::SimulationState& b) {
  return (a.vesicles[0].membrane.positions - b.vesicles[0].membrane.positions).abs().maxCoeff();
}

// Integral of (sigma0 ln dA/dA0)^2.
double strain_energy(SceneSimulation& simulation) {
  const vesicle::Membrane& membrane = simulation.membrane(0);
  const vesicle::ScalarField& area = membrane.surface().area_weight();
  return std::pow(simulation.scene().sigma0(0), 2) * ((area / membrane.target_areas()).log().square() * area).sum();
}

// What is lost is the history of the second-order step: it begins with a step of first order, whose error of dt^2 stays.
TEST_F(StartFrom, OnTheSameGridGoesOnButForTheHistory) {
  std::vector<double> differences;
  for (const char* step : {"1/64", "1/128"}) {
    SceneSimulation goes_on(scene_with({std::string("time.step='") + step + "'"}));
    while (!goes_on.finished()) goes_on.step();
    write_checkpoint(folder_ / "end.h5", goes_on);
    SceneSimulation anew(goes_on.scene());
    start_from(folder_ / "end.h5", anew);
    EXPECT_EQ(anew.time(), 0.0);
    EXPECT_EQ(largest_difference(anew.state(), goes_on.state()), 0.0);
    EXPECT_LT((anew.marker_velocity(0) - goes_on.marker_velocity(0)).abs().maxCoeff(), 0.05);
    const long steps = goes_on.steps() / 2;
    for (long i = 0; i < steps; ++i) {
      goes_on.step();
      anew.step();
    }
    differences.push_back(largest_difference(anew.state(), goes_on.state()));
  }
  EXPECT_LT(differences[0], 1e-3);
  EXPECT_NEAR(differences[1] / differences[0], 0.25, 0.15);
}

TEST_F(StartFrom, AFinerGridAndMeshHaveTheSameVesicle) {
  const CheckpointContents end = read_checkpoint(first_ / "checkpoint.h5");
  SceneSimulation run_itself(end.scene);
  run_itself.restore(end.state);
  SceneSimulation fine(scene_with({"domain.cells=30", "mesh.latitudes=20", "membrane.g=5"}));
  start_from(first_, fine);
  const vesicle::Diagnostics a = run_itself.measure()[0], b = fine.measure()[0];
  EXPECT_NEAR(b.area_error, a.area_error, 1e-9);
  EXPECT_NEAR(b.volume_error, a.volume_error, 1e-9);
  EXPECT_NEAR(b.inclination_angle, a.inclination_angle, 1e-9);
  EXPECT_NEAR(b.bending_energy, a.bending_energy, 1e-6);
  // sigma0 times the strain is that of the run, whatever the stiffness.
  ASSERT_NE(fine.scene().sigma0(0), end.scene.sigma0(0));
  EXPECT_NEAR(strain_energy(fine) / strain_energy(run_itself), 1.0, 1e-5);
  EXPECT_LT(fine.max_divergence(), 1e-11);
  EXPECT_EQ(fine.steps(), 0);
  ASSERT_NE(fine.started_from(), nullptr);
  EXPECT_EQ(fine.started_from()->run, (first_ / "checkpoint.h5").string());
  EXPECT_EQ(fine.started_from()->time, run_itself.time());
  for (int i = 0; i < 3; ++i) fine.step();
  EXPECT_NEAR(fine.measure()[0].inclination_angle, b.inclination_angle, 0.05);
  EXPECT_NEAR(fine.measure()[0].volume_error, a.volume_error, 1e-6) << "kept against the volume of the run";
}

// Over the membrane.
double mean_tension(SceneSimulation& simulation) {
  const vesicle::Membrane& membrane = simulation.membrane(0);
  const vesicle::ScalarField& area = membrane.surface().area_weight();
  return simulation.scene().sigma0(0) * ((area / membrane.target_areas()).log() * area).sum() / area.sum();
}

// The strain of a run that follows the shape has a mean that is not of its area, and one that is scaled has another.
TEST_F(StartFrom, MaterialMarkersKeepTheMeanTension) {
  const CheckpointContents end = read_checkpoint(first_ / "checkpoint.h5");
  SceneSimulation run_itself(end.scene);
  run_itself.restore(end.state);
  const double tension = mean_tension(run_itself);
  for (const char* markers : {"euler", "ab2", "strain_relaxation", "arkode"})
    for (const char* g : {"3", "6"}) {
      SCOPED_TRACE(std::string(markers) + ", g = " + g);
      const Scene scene =
          scene_with({std::string("time.markers=") + markers, std::string("membrane.g=") + g, "time.step='1/4096'"});
      SceneSimulation simulation(scene);
      start_from(first_, simulation);
      const double total = simulation.membrane(0).target_areas().sum();
      // Target areas scaled back to the initial area would lose it all: the area of the run is exact, its mean strain is held beside it.
      const double lost = scene.sigma0(0) * std::abs(std::log(total / simulation.membrane(0).initial_area()));
      ASSERT_NEAR(lost, std::abs(tension), 1e-3 * std::abs(tension));
      EXPECT_NEAR(mean_tension(simulation), tension, 1e-3 * std::abs(tension));
      const double area = simulation.membrane(0).surface().area();
      simulation.step();
      EXPECT_NEAR(simulation.membrane(0).target_areas().sum(), total, 1e-13 * total);
      // What the area itself has changed by in the step, the membrane's own motion, is all that the mean tension has.
      const double moved = scene.sigma0(0) * std::log(simulation.membrane(0).surface().area() / area);
      EXPECT_NEAR(mean_tension(simulation) - moved, tension, 1e-2 * std::abs(tension));

      write_checkpoint(folder_ / "one_step.h5", simulation);
      SceneSimulation restarted(scene);
      restore_checkpoint(folder_ / "one_step.h5", restarted);
      for (SceneSimulation* each : {&simulation, &restarted}) each->step();
      EXPECT_TRUE((restarted.membrane(0).target_areas() == simulation.membrane(0).target_areas()).all());
      EXPECT_EQ(largest_difference(restarted.state(), simulation.state()), 0.0);
    }
}

// What the scene says of the shape counts no more: another reduced volume is not striven for, not by a restarted run either.
TEST_F(StartFrom, RestartedAndRepeatedRunsHaveTheSameBits) {
  const Scene scene = scene_with({"vesicles.0.reduced_volume=0.8", "membrane.area=projection", "domain.cells=24",
                                  "output.checkpoint_every='4/64'", "output.diagnostics_every='2/64'"});
  const auto run_into = [&](const char* name, const Scene& what, RunOptions options) {
    SceneSimulation simulation(what);
    options.directory = folder_ / name;
    options.quiet = true;
    run(simulation, options);
    return simulation.measure()[0].reduced_volume;
  };
  const double reduced_volume = run_into("whole", scene, {.start_from = first_});
  EXPECT_NEAR(reduced_volume, 0.95, 2e-3);
  Scene half = scene;
  half.time.end = 4.0 / 64;
  run_into("parts", half, {.start_from = first_});
  run_into("parts", scene, {.checkpoint = folder_ / "parts/checkpoint.h5"});
  run_into("again", scene, {.checkpoint = folder_ / "whole/start.h5"});
  const coupling::SimulationState whole = read_checkpoint(folder_ / "whole/checkpoint.h5").state;
  for (const char* name : {"parts", "again"}) {
    const coupling::SimulationState other = read_checkpoint(folder_ / name / "checkpoint.h5").state;
    EXPECT_EQ(largest_difference(other, whole), 0.0) << name;
    EXPECT_TRUE((other.vesicles[0].membrane.target_areas == whole.vesicles[0].membrane.target_areas).all()) << name;
    EXPECT_EQ(other.clock.steps, whole.clock.steps);
    ASSERT_TRUE(other.start);
    EXPECT_EQ(other.start->run, (first_ / "checkpoint.h5").string());
    EXPECT_NE(text_of(folder_ / name / "summary.json").find("\"run\": \"" + other.start->run), std::string::npos);
    EXPECT_EQ(text_of(folder_ / name / "diagnostics.csv"), text_of(folder_ / "whole/diagnostics.csv"));
  }
  EXPECT_TRUE(text_of(folder_ / "whole/scene.toml").starts_with("# This run started from another one"));
  EXPECT_NO_THROW(load_scene(folder_ / "whole/scene.toml"));
  EXPECT_NE(text_of(first_ / "summary.json").find("\"started_from\": null"), std::string::npos);
}

TEST_F(StartFrom, OutsideTheBoxOfTheRunThereIsTheFlowOfTheScene) {
  SceneSimulation simulation(scene_with({"domain.lower=[-4.5, -3, -3]", "domain.cells=[25, 20, 20]"}));
  const fluid::Field<fluid::FaceX> before = simulation.fluid().velocity().x.clone();
  start_from(first_, simulation);
  // Only its divergence-free part is taken, which hardly changes what is far away.
  const fluid::Field<fluid::FaceX>& after = simulation.fluid().velocity().x;
  EXPECT_NEAR(after(2, 10, 4), before(2, 10, 4), 1e-2);
  EXPECT_NEAR(after(10, 10, 10), read_checkpoint(first_ / "checkpoint.h5").state.velocity.x(5, 10, 10), 1e-1);
  EXPECT_NO_THROW(simulation.step());
}

// A run with sharp membranes between two viscosities is solved for mu u, and its checkpoint has that; what comes over is u.
TEST_F(StartFrom, TheVelocityOfARunWithSharpMembranesIsThatOfItsFluid) {
  const Scene sharp = scene_with({"coupling.method=sharp", "fluid.inertia=none", "fluid.viscosity_ratio=5"});
  SceneSimulation simulation(sharp);
  run(simulation, {.directory = folder_ / "sharp", .quiet = true});
  ASSERT_GT((read_checkpoint(folder_ / "sharp/checkpoint.h5").state.velocity.x(10, 10, 12) /
             simulation.fluid_velocity().x(10, 10, 12)),
            4.9)
      << "or this tests nothing";
  for (const Scene& scene : {scene_with({}), scene_with({"fluid.viscosity_ratio=5"}), sharp}) {
    SceneSimulation anew(scene);
    start_from(folder_ / "sharp", anew);
    // But for what makes it free of divergence next to the membrane.
    const fluid::Field<fluid::FaceX>& u = simulation.fluid_velocity().x;
    const fluid::Field<fluid::FaceX>& at_start = anew.fluid_velocity().x;
    for (int k = 0; k < u.extent(2); ++k) EXPECT_NEAR(at_start(10, 10, k), u(10, 10, k), 0.1) << k;
    // A delta function reads a velocity that is given, and smooths the kink at the membrane: 0.16 of a speed of about 1.
    EXPECT_LT((anew.marker_velocity(0) - simulation.marker_velocity(0)).abs().maxCoeff(), 0.25);
    EXPECT_NO_THROW(anew.step());
  }
}

TEST_F(StartFrom, WhatDoesNotFitIsRefusedByName) {
  const Scene scene = scene_with({});
  Scene two = scene;
  two.vesicles[0].radius = 0.6;
  two.vesicles.push_back(two.vesicles[0]);
  two.vesicles[0].centre = {-1.5, 0, 0};
  two.vesicles[1].centre = {1.5, 0, 0};
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(refusal(first_, two), "the run has 1 vesicles, this scene has 2");
  expect(refusal(folder_ / "none", scene), "there is no such folder or file");
  expect(refusal(folder_, scene), "the folder has no checkpoint.h5");
  expect(refusal(first_ / "scene.toml", scene), "this checkpoint cannot be used");
  Scene small = scene;
  small.domain.lower[0] = -1.15;
  small.domain.upper[0] = 1.15;
  small.vesicles[0].radius = 0.6;
  expect(refusal(first_, small), "vesicle 0 reaches from");
  Scene mirrored = scene;
  mirrored.domain.lower[1] = 0.0;
  mirrored.domain.mirror[1] = true;
  mirrored.domain.cells[1] = 10;
  expect(refusal(first_, mirrored), "domain.mirror and domain.lower of axis y");
  Scene larger = scene;
  larger.vesicles[0].radius = 1.011;
  expect(refusal(first_, larger), "vesicles.0.radius = 1.011: the vesicle of the run has the effective radius 1,");
  expect(refusal(first_, larger), "set vesicles.0.radius = 1, --set vesicles.0.radius=1");
  larger.vesicles[0].radius = 1.009;
  EXPECT_EQ(refusal(first_, larger), "none");
  SceneSimulation other(scene_with({"membrane.g=4"}));
  try {
    restore_checkpoint(first_ / "checkpoint.h5", other);
    FAIL() << "a restart keeps its parameters";
  } catch (const SceneError& error) {
    expect(error.what(), "--start-from in the place of --restart");
  }
}

}  // namespace
}  // namespace vesiflow::run::start_from_test
