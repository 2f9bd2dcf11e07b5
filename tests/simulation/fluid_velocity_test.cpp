// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The velocity that users see, where sharp membranes are between two viscosities and the fluid is solved for mu u.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "coupling/errors.h"
#include "coupling/marker_transfer.h"
#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling::fluid_velocity_test {
namespace {

Overrides sharp(std::initializer_list<std::string> more) {
  Overrides all{"coupling.method=sharp", "fluid.inertia=none", "time.markers=shape_following", "time.step=1/24",
                "domain.cells=20"};
  all.insert(all.end(), more);
  return all;
}

void advance(SceneSimulation& simulation, long steps) {
  for (long i = 0; i < steps; ++i) simulation.step();
}

double greatest_speed(const vesicle::VectorField& velocity) {
  return velocity.square().rowwise().sum().sqrt().maxCoeff();
}

// The velocity of the fluid at the markers, over those of both sides, less that of the membrane, relative.
double distance_from_membrane(const SceneSimulation& simulation, const vesicle::VectorField& markers,
                              const fluid::FaceVector& velocity) {
  MarkerTransfer transfer(simulation.fluid().grid());
  transfer.update(markers);
  vesicle::VectorField at_markers(markers.rows(), 3);
  transfer.interpolate(velocity, at_markers);
  const vesicle::VectorField& membrane = simulation.marker_velocity(0);
  return greatest_speed(at_markers - membrane) / greatest_speed(membrane);
}

template <class Centring>
bool same(const fluid::Field<Centring>& a, const fluid::Field<Centring>& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

bool same(const fluid::FaceVector& a, const fluid::FaceVector& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

// What is solved for jumps at the membrane by (1 - ratio) U. u is continuous, and U on it, whatever the ratio: a delta function, which
// takes the mean over the kink of u there, comes to it in first order of the spacing, and to a mean of both sides of the other never.
TEST(FluidVelocity, GoesOnSmoothlyAcrossAMembraneBetweenTwoViscosities) {
  for (const char* ratio : {"0.2", "5", "20"}) {
    const auto distances = [&](const char* cells) {
      SceneSimulation simulation(
          small_scene(sharp({std::string("fluid.viscosity_ratio=") + ratio, std::string("domain.cells=") + cells})));
      advance(simulation, 3);
      const vesicle::VectorField& markers = simulation.membrane(0).positions();
      return std::pair(distance_from_membrane(simulation, markers, simulation.fluid_velocity()),
                       distance_from_membrane(simulation, markers, simulation.fluid().velocity()));
    };
    const auto [coarse, coarse_of_solver] = distances("20");
    const auto [fine, fine_of_solver] = distances("40");
    EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.3) << ratio;
    EXPECT_LT(fine, 0.2) << ratio;
    EXPECT_GT(fine_of_solver, 0.9 * coarse_of_solver) << ratio;
    EXPECT_GT(fine_of_solver, 0.4) << ratio;
  }
}

// The ratio goes through the whole of the inside, and nothing else is changed.
TEST(FluidVelocity, IsThatOfTheSolverOverTheRatioInsideAndTheSameOutside) {
  SceneSimulation simulation(small_scene(sharp({"fluid.viscosity_ratio=5"})));
  advance(simulation, 2);
  const auto u = simulation.fluid_velocity().points();
  const auto w = simulation.fluid().velocity().points();
  const double volume = simulation.membrane(0).surface().volume();
  for (std::size_t c = 0; c < 3; ++c) {
    int inside = 0;
    for (int k = -1; k <= u[c].extent[2]; ++k)
      for (int j = -1; j <= u[c].extent[1]; ++j)
        for (int i = -1; i <= u[c].extent[0]; ++i) {
          if (w[c](i, j, k) == 0.0 || u[c](i, j, k) == w[c](i, j, k)) continue;
          EXPECT_EQ(u[c](i, j, k), w[c](i, j, k) * (1.0 / 5.0));
          ++inside;
        }
    // Of 155 points 50 are next to the membrane, on either side by chance.
    EXPECT_NEAR(inside * simulation.fluid().grid().cell_volume() / volume, 1.0, 0.1) << c;
  }
}

TEST(FluidVelocity, IsThatOfTheSolverElsewhere) {
  for (const Overrides& overrides :
       {sharp({}), Overrides{"fluid.viscosity_ratio=5", "domain.cells=16"}, Overrides{"domain.cells=16"}}) {
    SceneSimulation simulation(small_scene(overrides));
    for (int step = 0; step < 2; ++step, simulation.step())
      EXPECT_EQ(&simulation.fluid_velocity(), &simulation.fluid().velocity());
    EXPECT_EQ(simulation.interface_passes(), 0);
  }
}

// No step has made mu u of it yet: it is the undisturbed flow, inside too, and the membrane moves with it.
TEST(FluidVelocity, IsTheUndisturbedFlowAtFirst) {
  SceneSimulation simulation(small_scene(sharp({"fluid.viscosity_ratio=5"})));
  const fluid::Field<fluid::FaceX>& u = simulation.fluid_velocity().x;
  for (int k = 0; k < u.extent(2); ++k) EXPECT_NEAR(u(10, 10, k), u.position(10, 10, k)[2], 1e-12);
  const vesicle::VectorField& membrane = simulation.marker_velocity(0);
  const vesicle::VectorField& markers = simulation.membrane(0).positions();
  EXPECT_LT((membrane.col(0) - markers.col(2)).abs().maxCoeff(), 1e-12);
  EXPECT_LT(membrane.rightCols<2>().abs().maxCoeff(), 1e-12);
}

// A sinking vesicle in a box that repeats along all axes: the mean of u is zero and that of mu u is not.
TEST(FluidVelocity, HasNoMeanInAPeriodicBox) {
  for (const char* ratio : {"0.2", "5"}) {
    SceneSimulation simulation(
        small_scene(sharp({"flow.type=rest", "domain.periodic=[true, true, true]", "gravity.acceleration=[1, 0, -2]",
                           "vesicles.density_difference=3", std::string("fluid.viscosity_ratio=") + ratio})));
    advance(simulation, 2);
    const auto mean_over_speed = [&](const fluid::FaceVector& velocity, std::size_t axis) {
      const fluid::ConstView values = velocity.unknowns()[axis];
      double sum = 0.0;
      for (int k = 0; k < values.extent[2]; ++k)
        for (int j = 0; j < values.extent[1]; ++j)
          for (int i = 0; i < values.extent[0]; ++i) sum += values(i, j, k);
      const double points = 1.0 * values.extent[0] * values.extent[1] * values.extent[2];
      return sum / points / greatest_speed(simulation.marker_velocity(0));
    };
    // The points inside are a tenth more or fewer than the volume, which is 0.019 of the box.
    for (const std::size_t axis : {0U, 2U})
      EXPECT_LT(std::abs(mean_over_speed(simulation.fluid_velocity(), axis)), 2.5e-3) << ratio << " " << axis;
    // The field that is solved for has none either, so that what it is over the ratio has.
    const auto u = simulation.fluid_velocity().points();
    const double added = u[2](1, 1, 1) - simulation.fluid().velocity().z(1, 1, 1);
    EXPECT_GT(std::abs(added), 5e-3 * greatest_speed(simulation.marker_velocity(0))) << ratio;
    // The repeated face and the ghosts are those of the other end.
    EXPECT_EQ(u[2](3, 4, u[2].extent[2] - 1), u[2](3, 4, 0));
    EXPECT_EQ(u[2](3, 4, -1), u[2](3, 4, u[2].extent[2] - 2));
  }
}

// Two vesicles, each by its own ratio, one of them across the end of a box that repeats.
TEST(FluidVelocity, TakesEachMembraneByItsOwnRatio) {
  Scene scene = small_scene(
      sharp({"domain.upper=[6, 3, 3]", "domain.cells=[30, 20, 20]", "domain.periodic=[true, true, false]"}));
  scene.vesicles[0].viscosity_ratio = 4.0;
  scene.vesicles[0].centre = {-2.8, 0.1, 0.2};
  scene.vesicles.push_back(scene.vesicles[0]);
  scene.vesicles[1].viscosity_ratio = 0.5;
  scene.vesicles[1].centre = {2.0, -2.9, 0.0};
  SceneSimulation simulation(scene);
  advance(simulation, 2);
  const fluid::Field<fluid::FaceX>& u = simulation.fluid_velocity().x;
  const fluid::Field<fluid::FaceX>& w = simulation.fluid().velocity().x;
  const auto ratio_at = [&](double x, double y, double z) {
    const int i = static_cast<int>(std::lround((x + 3.0) / 0.3)), j = static_cast<int>((y + 3.0) / 0.3),
              k = static_cast<int>((z + 3.0) / 0.3);
    return w(i, j, k) / u(i, j, k);
  };
  EXPECT_NEAR(ratio_at(-2.5, 0.1, 0.5), 4.0, 1e-12);
  EXPECT_NEAR(ratio_at(5.9, 0.1, 0.5), 4.0, 1e-12);  // beyond the end
  EXPECT_NEAR(ratio_at(2.0, -2.8, 0.4), 0.5, 1e-12);
  EXPECT_NEAR(ratio_at(2.0, 2.9, 0.4), 0.5, 1e-12);
  EXPECT_NEAR(ratio_at(0.0, 0.0, 2.0), 1.0, 1e-12);
}

// From a state alone, as a run that starts from another one does.
TEST(FluidVelocity, OfAStateIsThatOfTheSimulationThatIsRestoredToIt) {
  for (const auto& [periodic, inertia] : {std::pair{false, "none"}, {true, "none"}, {true, "full"}}) {
    Overrides overrides = sharp({"fluid.viscosity_ratio=5", std::string("fluid.inertia=") + inertia});
    if (periodic)
      for (const char* key : {"flow.type=rest", "domain.periodic=[true, true, true]", "gravity.acceleration=[1, 0, -2]",
                              "vesicles.density_difference=3"})
        overrides.emplace_back(key);
    const Scene scene = small_scene(overrides);
    SceneSimulation simulation(scene), restored(scene);
    EXPECT_TRUE(same(fluid_velocity_of(scene, simulation.state()), simulation.fluid_velocity()));
    advance(simulation, 2);
    const SimulationState state = simulation.state();
    restored.restore(state);
    const fluid::FaceVector u = fluid_velocity_of(scene, state);
    EXPECT_TRUE(same(u, restored.fluid_velocity()));
    // The membrane has hardly moved from where the forces of the last step were, and few of 155 points have changed sides.
    const fluid::Field<fluid::FaceZ>& exact = simulation.fluid_velocity().z;
    int changed = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) changed += u.z.data()[i] == exact.data()[i] ? 0 : 1;
    EXPECT_LE(changed, 8);
  }
  const Scene of_delta = small_scene();
  SceneSimulation simulation(of_delta);
  simulation.step();
  EXPECT_TRUE(same(fluid_velocity_of(of_delta, simulation.state()), simulation.fluid().velocity()));
}

TEST(FluidVelocity, AStateWithoutTheVelocityOfTheMembraneIsRefused) {
  const Scene scene = small_scene(sharp({"fluid.viscosity_ratio=5"}));
  SceneSimulation simulation(scene);
  simulation.step();
  SimulationState state = simulation.state();
  state.vesicles[0].interface_velocity.resize(0, 3);
  EXPECT_THROW(fluid_velocity_of(scene, state), std::invalid_argument);
  EXPECT_THROW(simulation.restore(state), std::invalid_argument);
  state = simulation.state();
  state.vesicles[0].interface_velocity(3, 1) = std::nan("");
  EXPECT_THROW(simulation.restore(state), std::invalid_argument);
  state.vesicles.clear();
  EXPECT_THROW(fluid_velocity_of(scene, state), std::invalid_argument);
}

// The guard looks in every eighth step, and mu u inside is then 20 times what walls and membranes have.
TEST(FluidVelocity, IsWhatTheGuardAgainstBlowUpsLooksAt) {
  SceneSimulation simulation(small_scene(sharp({"fluid.viscosity_ratio=20", "vesicles.rotation_deg=0"})));
  EXPECT_NO_THROW(advance(simulation, 8));
  double greatest = 0.0;
  for (const fluid::ConstView& w : simulation.fluid().velocity().points())
    for (int k = 0; k < w.extent[2]; ++k)
      for (int j = 0; j < w.extent[1]; ++j)
        for (int i = 0; i < w.extent[0]; ++i) greatest = std::max(greatest, std::abs(w(i, j, k)));
  EXPECT_GT(greatest, 9.0) << "or this tests nothing: walls move at 3, and the guard's limit is three times that";
}

}  // namespace
}  // namespace vesiflow::coupling::fluid_velocity_test
