// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The velocity that users see, where sharp membranes are between two viscosities and the fluid is solved for mu u.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "coupling/errors.h"
#include "coupling/marker_transfer.h"
#include "coupling/simulation.h"
#include "support/small_scene.h"

namespace vesiflow::coupling {
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

}  // namespace
}  // namespace vesiflow::coupling
