// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Runs that go on from a checkpoint end in the state of a run in one piece, bit for bit.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "coupling/marker_integrator.h"
#include "run/checkpoint.h"
#include "run/run_in_folder.h"
#include "support/small_scene.h"

namespace vesiflow::run::restart_test {
namespace {

using coupling::have_sundials, coupling::small_scene, coupling::three_vesicles;

class Restart : public RunInFolder {};

// The final state of a run, for comparison to the last bit.
void expect_same_state(const fs::path& a, const fs::path& b, const Scene& scene) {
  SceneSimulation first(scene), second(scene);
  restore_checkpoint(a, first);
  restore_checkpoint(b, second);
  const coupling::SimulationState x = first.state(), y = second.state();
  EXPECT_EQ(x.clock.steps, y.clock.steps);
  EXPECT_EQ(x.clock.time, y.clock.time);
  const auto same = [](const auto& f, const auto& g) { return std::equal(f.data(), f.data() + f.size(), g.data()); };
  EXPECT_TRUE(same(x.velocity.x, y.velocity.x));
  EXPECT_TRUE(same(x.velocity.y, y.velocity.y));
  EXPECT_TRUE(same(x.velocity.z, y.velocity.z));
  EXPECT_TRUE(same(x.previous_velocity.x, y.previous_velocity.x));
  EXPECT_TRUE(same(x.pressure, y.pressure));
  for (std::size_t i = 0; i < x.vesicles.size(); ++i) {
    EXPECT_TRUE((x.vesicles[i].membrane.positions == y.vesicles[i].membrane.positions).all());
    EXPECT_TRUE((x.vesicles[i].membrane.target_areas == y.vesicles[i].membrane.target_areas).all());
    EXPECT_TRUE((x.vesicles[i].membrane.initial_areas == y.vesicles[i].membrane.initial_areas).all());
    EXPECT_TRUE((x.vesicles[i].membrane.lagged_strain == y.vesicles[i].membrane.lagged_strain).all());
    EXPECT_TRUE((x.vesicles[i].membrane.integral_tension == y.vesicles[i].membrane.integral_tension).all());
    EXPECT_EQ(x.vesicles[i].motion_history, y.vesicles[i].motion_history);
    EXPECT_EQ(x.vesicles[i].interface_velocity.rows(), y.vesicles[i].interface_velocity.rows());
    EXPECT_TRUE((x.vesicles[i].interface_velocity == y.vesicles[i].interface_velocity).all());
    EXPECT_EQ(x.vesicles[i].redistributions, y.vesicles[i].redistributions);
  }
  EXPECT_EQ(x.step_control, y.step_control);
}

void compare_restart(const fs::path& folder, const Overrides& overrides, int threads,
                     Scene (*make_scene)(const Overrides&) = small_scene) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Overrides half = overrides;
  half.emplace_back("time.end=0.25");
  const Scene whole_scene = make_scene(overrides);
  EXPECT_EQ(run_scene(whole_scene, folder / "whole"), RunStatus::completed);
  EXPECT_EQ(run_scene(make_scene(half), folder / "parts"), RunStatus::completed);
  EXPECT_EQ(run_scene(whole_scene, folder / "parts", folder / "parts" / "checkpoint.h5"), RunStatus::completed);
  expect_same_state(folder / "whole" / "checkpoint.h5", folder / "parts" / "checkpoint.h5", whole_scene);
  omp_set_num_threads(before);
}

TEST_F(Restart, ContinuesBitForBitWithOneThread) {
  compare_restart(folder_, {}, 1);
}

TEST_F(Restart, ContinuesBitForBitWithTwoThreads) {
  compare_restart(folder_, {}, 2);
}

TEST_F(Restart, ContinuesBitForBitWithMarkerHistory) {
  compare_restart(folder_, {"time.markers=ab2", "membrane.g=2"}, 2);
}

// Redistributed at steps 16, 32 and 48; the checkpoint is of step 24.
TEST_F(Restart, ContinuesBitForBitThroughRedistributions) {
  const Overrides always = {"mesh.max_aspect_ratio=1", "time.markers=ab2", "membrane.g=2"};
  compare_restart(folder_, always, 2);
  SceneSimulation simulation(small_scene(always));
  restore_checkpoint(at("parts") / "checkpoint.h5", simulation);
  EXPECT_EQ(simulation.redistributions(0), 3);
}

TEST_F(Restart, ContinuesBitForBitWithThePaperPreset) {
  compare_restart(folder_, {"method.preset=paper", "fluid.reynolds_number=1"}, 2);
}

// Latitudes, forces and redistributions of their own.
TEST_F(Restart, ContinuesSeveralVesiclesBitForBit) {
  compare_restart(folder_, {"mesh.max_aspect_ratio=1.5", "time.markers=ab2", "membrane.g=1.5"}, 2, three_vesicles);
  const std::string header = text_of(at("whole") / "diagnostics.csv").substr(0, 600);
  EXPECT_NE(header.find(",min_distance\n"), std::string::npos) << header;
}

// The field of viscosity is made anew from the markers; the velocity and the pressure to start iterations from are in the state.
TEST_F(Restart, ContinuesBitForBitWithEveryTreatmentOfTheViscosity) {
  const Overrides contrast{"fluid.viscosity_ratio=5", "domain.cells=16", "time.step=1/32", "time.end=0.375",
                           "output.checkpoint_every=0.125"};
  for (const char* treatment : {"explicit", "extrapolated", "implicit"}) {
    Overrides overrides = contrast;
    overrides.push_back(std::string("fluid.viscous_treatment=") + treatment);
    compare_restart(folder_ / treatment, overrides, 2);
    overrides.emplace_back("fluid.precision=mixed");
    compare_restart(folder_ / (std::string(treatment) + "_mixed"), overrides, 2);
  }
  Overrides without_inertia = contrast;
  without_inertia.emplace_back("fluid.inertia=none");
  compare_restart(folder_ / "none", without_inertia, 2);
}

// The iteration for the velocity of a membrane between two viscosities begins with that of the last step, which the state has.
TEST_F(Restart, ContinuesBitForBitWithSharpMembranes) {
  const Overrides all{"coupling.method=sharp", "fluid.inertia=none", "domain.cells=16",
                      "time.step=1/32",        "time.end=0.375",     "output.checkpoint_every=0.125"};
  const auto compare = [&](const char* name, std::initializer_list<std::string> more) {
    Overrides overrides = all;
    overrides.insert(overrides.end(), more);
    SCOPED_TRACE(name);
    compare_restart(folder_ / name, overrides, 2);
  };
  compare("equal", {"time.markers=shape_following"});
  compare("inertia", {"time.markers=shape_following", "fluid.inertia=full"});
  compare("thick", {"time.markers=shape_following", "fluid.viscosity_ratio=5"});
  compare("thin", {"time.markers=shape_following", "fluid.viscosity_ratio=0.2"});
  if (have_sundials()) compare("implicit", {"time.markers=implicit", "fluid.viscosity_ratio=5"});
}

TEST_F(Restart, ContinuesBitForBitWithVesiclesOfTheirOwnViscosity) {
  Scene scene = small_scene({"domain.cells=[36, 16, 16]", "domain.upper=[9, 3, 3]", "time.step=1/32", "time.end=0.25",
                             "output.checkpoint_every=0.125"});
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[0].viscosity_ratio = 8.0;
  scene.vesicles[1].centre = {5.0, 0.0, 0.0};
  scene.vesicles[1].viscosity_ratio = 0.2;
  run_scene(scene, at("whole"));
  Scene half = scene;
  half.time.end = 0.125;
  run_scene(half, at("parts"));
  run_scene(scene, at("parts"), at("parts") / "checkpoint.h5");
  expect_same_state(at("whole") / "checkpoint.h5", at("parts") / "checkpoint.h5", scene);
}

TEST_F(Restart, ContinuesBitForBitWithWhatTheTensionRemembers) {
  compare_restart(folder_, {"time.markers=strain_relaxation", "membrane.integral_rate=2"}, 2);
}

TEST_F(Restart, ContinuesBitForBitWithArkode) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  compare_restart(folder_, {"time.markers=arkode", "time.fluid_velocity=interpolated"}, 2);
}

// Three vesicles of different latitudes, each with its own forces, strain field and corrections that the fluid is owed.
const Overrides small_three{"domain.cells=[24, 16, 16]", "vesicles.0.latitudes=12", "vesicles.1.latitudes=14",
                            "vesicles.2.latitudes=10", "mesh.tangential_degrees=8"};

Overrides small_three_with(std::initializer_list<const char*> more) {
  Overrides all = small_three;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST_F(Restart, ContinuesSeveralVesiclesBitForBitWithShapeFollowing) {
  compare_restart(folder_ / "one", small_three_with({"time.markers=shape_following", "time.step=1/48"}), 1,
                  three_vesicles);
  compare_restart(folder_ / "two", small_three_with({"time.markers=shape_following", "time.step=1/48"}), 2,
                  three_vesicles);
}

// Markers are redistributed in steps 16 and 32; the checkpoint is of step 24, and the motions have started anew before it.
TEST_F(Restart, ContinuesShapeFollowingBitForBitThroughRedistributions) {
  const Overrides always = small_three_with({"time.markers=shape_following", "mesh.max_aspect_ratio=1"});
  compare_restart(folder_, always, 2, three_vesicles);
  SceneSimulation simulation(three_vesicles(always));
  restore_checkpoint(at("parts") / "checkpoint.h5", simulation);
  EXPECT_GT(simulation.redistributions(0), 1);
}

TEST_F(Restart, ContinuesShapeFollowingBitForBitWithAViscosityContrast) {
  for (const char* treatment : {"explicit", "extrapolated", "implicit"})
    compare_restart(folder_ / treatment,
                    small_three_with({"time.markers=shape_following", "time.step=1/24", "vesicles.0.viscosity_ratio=5",
                                      "vesicles.2.viscosity_ratio=0.5",
                                      (std::string("fluid.viscous_treatment=") + treatment).c_str()}),
                    2, three_vesicles);
  compare_restart(folder_ / "none",
                  small_three_with({"time.markers=shape_following", "time.step=1/16", "vesicles.0.viscosity_ratio=5",
                                    "fluid.inertia=none"}),
                  2, three_vesicles);
}

TEST_F(Restart, ContinuesSeveralVesiclesBitForBitWithStrainRelaxation) {
  compare_restart(folder_, small_three_with({"time.markers=strain_relaxation", "membrane.integral_rate=2"}), 2,
                  three_vesicles);
}

TEST_F(Restart, ContinuesSeveralVesiclesBitForBitWithArkode) {
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS";
  compare_restart(folder_, small_three_with({"time.markers=arkode", "time.fluid_velocity=interpolated"}), 2,
                  three_vesicles);
}

// The state between two steps of different lengths, one of them refused, through a file.
TEST_F(Restart, ContinuesSeveralVesiclesBitForBitWithAdaptiveShapeFollowing) {
  fs::create_directories(folder_);
  const Scene scene = three_vesicles(small_three_with(
      {"time.markers=shape_following", "time.adaptive=true", "time.tolerance=3e-5", "time.step=1/24", "time.end=0.4"}));
  SceneSimulation whole(scene), continued(scene);
  while (whole.time() < 0.2) whole.step();
  EXPECT_GT(whole.rejected_steps(), 0);
  write_checkpoint(at("middle.h5"), whole);
  while (!whole.finished()) whole.step();
  write_checkpoint(at("whole.h5"), whole);
  restore_checkpoint(at("middle.h5"), continued);
  while (!continued.finished()) continued.step();
  write_checkpoint(at("continued.h5"), continued);
  expect_same_state(at("whole.h5"), at("continued.h5"), scene);
}

// With refused steps, and with a history of the integrator beside that of the error.
TEST_F(Restart, ContinuesBitForBitWithAdaptiveSteps) {
  fs::create_directories(folder_);
  for (const char* markers : {"time.markers=euler", "time.markers=ab2", "time.markers=strain_relaxation"}) {
    const Scene scene =
        small_scene({"time.adaptive=true", "time.tolerance=2e-5", "limits.area_error=2e-4", "membrane.g=2", markers});
    SceneSimulation whole(scene), continued(scene);
    for (int i = 0; i < 12; ++i) whole.step();
    EXPECT_GT(whole.rejected_steps(), 0);
    write_checkpoint(at("middle.h5"), whole);
    while (!whole.finished()) whole.step();
    write_checkpoint(at("whole.h5"), whole);
    restore_checkpoint(at("middle.h5"), continued);
    while (!continued.finished()) continued.step();
    write_checkpoint(at("continued.h5"), continued);
    expect_same_state(at("whole.h5"), at("continued.h5"), scene);
  }
}

}  // namespace
}  // namespace vesiflow::run::restart_test
