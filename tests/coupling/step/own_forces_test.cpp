// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/flow.h"
#include "coupling/simulation.h"

namespace vesiflow::coupling::own_forces_test {
namespace {

SimulationParameters sphere_between_walls() {
  SimulationParameters parameters;
  parameters.domain = {.lower = {-3, -3, -3}, .upper = {3, 3, 3}, .cells = {24, 24, 24}};
  parameters.mesh.latitudes = 16;
  parameters.time.step = 1.0 / 48.0;
  parameters.time.end = 0.5;
  parameters.vesicles.resize(1);
  parameters.vesicles[0].shape = Shape::sphere;
  return parameters;
}

vesicle::VectorField positions_after(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
  return simulation.membrane(0).positions();
}

// Buoyancy is the force (density difference) (g . x) n per area: a program that adds it moves the vesicle as gravity does.
TEST(OwnForces, BuoyancyByAProgramIsBuoyancy) {
  SimulationParameters parameters = sphere_between_walls();
  Simulation own(parameters, flow_at_rest());
  own.add_force([](double, std::size_t, const vesicle::Surface& surface, vesicle::VectorField& force) {
    force += surface.normal().colwise() * (surface.positions().col(2) * -2.0);
  });
  parameters.gravity.acceleration = {0.0, 0.0, -1.0};
  parameters.vesicles[0].density_difference = 2.0;
  Simulation gravity(parameters, flow_at_rest());
  const vesicle::VectorField a = positions_after(own, 6), b = positions_after(gravity, 6);
  EXPECT_LT(b.col(2).mean(), -1e-3);
  EXPECT_LT((a - b).abs().maxCoeff(), 1e-3 * std::abs(b.col(2).mean()));
}

// A gradient drives nothing between walls: the pressure takes it up, at once where velocity and pressure are solved for together. A rotation
// about y turns the vesicle for as long as it is there.
TEST(OwnForces, OfTheFluidMovesWhatThePressureCannotTakeUp) {
  SimulationParameters parameters = sphere_between_walls();
  parameters.fluid.inertia = fluid::Inertia::none;
  Simulation at_rest(parameters, flow_at_rest()), turning(parameters, flow_at_rest());
  at_rest.set_fluid_force([](const fluid::Vector3& x, double) { return fluid::Vector3{x[0], -2.0 * x[1], x[2]}; });
  turning.set_fluid_force([](const fluid::Vector3& x, double) { return fluid::Vector3{x[2], 0.0, -x[0]}; });
  positions_after(at_rest, 2);
  positions_after(turning, 2);
  const double speed = turning.marker_velocity(0).abs().maxCoeff();
  EXPECT_GT(speed, 0.1);
  EXPECT_LT(at_rest.marker_velocity(0).abs().maxCoeff(), 1e-5 * speed);
  turning.set_fluid_force(nullptr);
  positions_after(turning, 12);  // what the membrane was strained dies out
  EXPECT_LT(turning.marker_velocity(0).abs().maxCoeff(), 1e-2 * speed);
}

TEST(OwnForces, ThereMustBeAFunction) {
  Simulation simulation(sphere_between_walls(), flow_at_rest());
  EXPECT_THROW(simulation.add_force(nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::own_forces_test
