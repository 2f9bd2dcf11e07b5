// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/membrane.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::membrane_test {
namespace {

constexpr int latitudes = 20;
constexpr double dt = 0.01;

VectorField start() {
  return prolate(SphereGrid(latitudes), 0.9);
}

/// The shear flow (z, 0, 0) at the markers, slowed by the tension so that the forces matter to the
/// trajectory.
void step(Membrane& membrane) {
  membrane.update_geometry();
  VectorField velocity = 1e-3 * membrane.compute_force();
  velocity.col(0) += membrane.positions().col(2);
  VectorField filtered;
  membrane.filter_velocity(velocity, dt, filtered);
  membrane.advance(membrane.positions() + dt * filtered, velocity, filtered, dt);
}

TEST(Membrane, StartsUnstretched) {
  Membrane membrane(start(), latitudes, {});
  EXPECT_TRUE((membrane.target_areas() == membrane.initial_areas()).all());
  EXPECT_EQ(membrane.initial_area(), membrane.surface().area());
  membrane.compute_force();
  EXPECT_EQ(membrane.tension().abs().maxCoeff(), 0);
}

TEST(Membrane, ForceIsTheSumOfWhatIsSwitchedOn) {
  constexpr double off = std::numeric_limits<double>::infinity();
  const VectorField pulled = start() * 1.02;
  const auto force = [&](const MembraneParameters& parameters) {
    Membrane membrane(start(), latitudes, parameters);
    MembraneState state = membrane.state();
    state.positions = pulled;
    membrane.restore(state);
    return VectorField(membrane.compute_force());
  };
  MembraneParameters all{.volume = VolumeControl::penalty, .volume_stiffness = 100};
  MembraneParameters bending = all, tension = all, penalty = all, nothing = all;
  bending.sigma0 = penalty.sigma0 = nothing.sigma0 = 0;
  tension.capillary_number = penalty.capillary_number = nothing.capillary_number = off;
  bending.volume = tension.volume = nothing.volume = VolumeControl::none;
  EXPECT_EQ(force(nothing).abs().maxCoeff(), 0);
  const VectorField sum = force(bending) + force(tension) + force(penalty);
  EXPECT_LT((force(all) - sum).abs().maxCoeff(), 1e-12 * sum.abs().maxCoeff());
  EXPECT_GT(force(penalty).abs().maxCoeff(), 1);
}

TEST(Membrane, EnergyHasTheForceAsItsGradient) {
  Membrane membrane(start(), latitudes, {.volume = VolumeControl::penalty, .volume_stiffness = 50});
  MembraneState state = membrane.state();
  const VectorField shape = start() * 1.01 + 0.01 * testing::smooth_vector(membrane.surface().grid(), 3, 91);
  state.positions = shape;
  membrane.restore(state);
  const VectorField force = membrane.compute_force();
  const VectorField direction = testing::smooth_vector(membrane.surface().grid(), 3, 92);
  const double power = testing::work(membrane.surface(), force, direction);
  const double slope = testing::directional_derivative(
      [&](const VectorField& x) {
        state.positions = x;
        membrane.restore(state);
        return membrane.energy();
      },
      shape, direction, 1e-3);
  EXPECT_NEAR(-power, slope, 1e-6 * std::abs(slope));
}

TEST(Membrane, VolumeIsKeptByProjection) {
  Membrane membrane(start(), latitudes, {});
  for (int k = 0; k < 50; ++k) step(membrane);
  membrane.update_geometry();
  EXPECT_NEAR(membrane.surface().volume() / membrane.initial_volume(), 1, 1e-4);
  EXPECT_NEAR(membrane.target_areas().sum(), membrane.initial_area(), 1e-12);
}

/// A mean strain from elsewhere stays with a membrane that is told to keep it, also where another state is restored.
TEST(Membrane, KeepsTheTargetAreaThatItIsTold) {
  for (const bool told : {false, true}) {
    Membrane membrane(start(), latitudes, {});
    MembraneState state = membrane.state();
    state.target_areas *= 0.98;
    const double strained = state.target_areas.sum();
    membrane.restore(state);
    if (told) membrane.keep_target_area();
    const double kept = told ? strained : membrane.initial_area();
    step(membrane);
    EXPECT_NEAR(membrane.target_areas().sum(), kept, 1e-13 * kept);
    state.target_areas *= 1.01;
    membrane.restore(state);
    step(membrane);
    EXPECT_NEAR(membrane.target_areas().sum(), kept, 1e-13 * kept);
  }
}

TEST(Membrane, TargetAreasRestWithoutTension) {
  Membrane membrane(start(), latitudes, {.sigma0 = 0});
  for (int k = 0; k < 3; ++k) step(membrane);
  EXPECT_TRUE((membrane.target_areas() == membrane.initial_areas()).all());
}

TEST(Membrane, RestartRepeatsTheRunBitForBit) {
  const MembraneParameters remembering{.strain_relaxation = 0.25, .integral_tension = {.rate = 2}};
  for (const MembraneParameters& parameters : {MembraneParameters{}, remembering}) {
    Membrane straight(start(), latitudes, parameters);
    for (int k = 0; k < 3; ++k) step(straight);
    const MembraneState state = straight.state();
    Membrane resumed(start(), latitudes, parameters);
    resumed.restore(state);
    for (int k = 0; k < 3; ++k) {
      step(straight);
      step(resumed);
    }
    EXPECT_TRUE((straight.positions() == resumed.positions()).all());
    EXPECT_TRUE((straight.target_areas() == resumed.target_areas()).all());
    EXPECT_TRUE((straight.force() == resumed.force()).all());
    EXPECT_TRUE((straight.tension() == resumed.tension()).all());
    EXPECT_EQ(straight.initial_area(), resumed.initial_area());
  }
}

/// A mesh that does not move with the material: areas are those of the shape and of the strain that comes with it.
TEST(Membrane, MoveToTakesShapeAndStrain) {
  Membrane membrane(start(), latitudes, {});
  const double initial_area = membrane.initial_area();
  const VectorField shape = start() + 0.03 * testing::smooth_vector(membrane.surface().grid(), 4, 93);
  const ScalarField strain = 0.02 * testing::smooth_scalar(membrane.surface().grid(), 5, 94);
  membrane.move_to(shape, strain);
  EXPECT_TRUE((membrane.positions() == shape).all());
  Surface moved(latitudes);
  moved.update(shape);
  EXPECT_TRUE(
      (membrane.surface().area_weight() == moved.area_weight()).all());  // the geometry is that of the new shape
  EXPECT_LT(((moved.area_weight() / membrane.target_areas()).log() - strain).abs().maxCoeff(), 1e-14);
  EXPECT_LT((membrane.target_areas() - moved.area_weight() * (-strain).exp()).abs().maxCoeff(), 1e-16);
  EXPECT_NEAR(membrane.initial_area(), initial_area, 1e-14);  // the sum of areas scaled to it, so but for the last bits
  EXPECT_EQ(membrane.initial_areas().sum(), membrane.initial_area());
  const ScalarField ratio = membrane.initial_areas() / membrane.target_areas();
  EXPECT_LT(ratio.maxCoeff() - ratio.minCoeff(), 1e-14);
  // sigma = sigma0 ln J / J of Eq. (31) then has J = e^strain.
  membrane.compute_force();
  const ScalarField tension = membrane.parameters().sigma0 * strain * (-strain).exp();
  EXPECT_LT((membrane.tension() - tension).abs().maxCoeff(), 1e-10);
  // There and back.
  membrane.move_to(start(), ScalarField::Zero(shape.rows()));
  EXPECT_TRUE((membrane.target_areas() == membrane.surface().area_weight()).all());
  EXPECT_NEAR(membrane.initial_area(), initial_area, 2e-14);
}

TEST(Membrane, AFailingMoveToLeavesTheStateAlone) {
  Membrane membrane(start(), latitudes, {});
  const MembraneState before = membrane.state();
  const ScalarField strain = ScalarField::Constant(before.positions.rows(), 0.01);
  const auto unchanged = [&] {
    const MembraneState after = membrane.state();
    return (after.positions == before.positions).all() && (after.target_areas == before.target_areas).all() &&
           (after.initial_areas == before.initial_areas).all() && after.initial_volume == before.initial_volume;
  };
  testing::expect_refused_if_not_finite(strain, [&](const ScalarField& s) { membrane.move_to(start() * 1.1, s); });
  EXPECT_TRUE(unchanged());
  testing::expect_refused_if_not_finite(start(), [&](const VectorField& x) { membrane.move_to(x, strain); });
  EXPECT_TRUE(unchanged());
  EXPECT_THROW(membrane.move_to(start(), strain.head(5)), std::invalid_argument);
  EXPECT_THROW(membrane.move_to(start().topRows(5), strain), std::invalid_argument);
  EXPECT_THROW(membrane.move_to(VectorField::Zero(strain.size(), 3), strain), std::domain_error);
  EXPECT_TRUE(unchanged());
}

TEST(Membrane, RefusesBadArguments) {
  const auto make = [](const MembraneParameters& p) { return Membrane(start(), latitudes, p); };
  EXPECT_THROW(make({.capillary_number = 0}), std::invalid_argument);
  EXPECT_THROW(make({.sigma0 = -1}), std::invalid_argument);
  EXPECT_THROW(make({.volume_stiffness = -1}), std::invalid_argument);
  EXPECT_THROW(make({.normal_degrees = -1}), std::invalid_argument);
  EXPECT_THROW(make({.tangential_degrees = 0}), std::invalid_argument);
  EXPECT_THROW(Membrane(start(), latitudes + 1, {}), std::invalid_argument);
  VectorField mirrored = start();
  mirrored.col(0) *= -1;
  EXPECT_THROW(Membrane(mirrored, latitudes, {}), std::domain_error);
  Membrane membrane = make({});
  MembraneState state = membrane.state();
  state.target_areas[3] = 0;
  EXPECT_THROW(membrane.restore(state), std::invalid_argument);
}

TEST(Membrane, AStepThatIsNotFiniteIsRefusedAndChangesNothing) {
  const SphereGrid grid(8);
  for (const double sigma0 : {0.0, 100.0}) {
    Membrane membrane(prolate(grid, 0.9), 8, {.sigma0 = sigma0});
    const MembraneState good = membrane.state();
    const VectorField x = 1.01 * good.positions;
    VectorField u = testing::smooth_vector(grid, 4, 5), filtered;
    membrane.filter_velocity(u, 0.1, filtered);
    testing::expect_refused_if_not_finite(u, [&](const VectorField& v) {
      VectorField unused;
      membrane.filter_velocity(v, 0.1, unused);
    });
    testing::expect_refused_if_not_finite(x, [&](const VectorField& y) { membrane.advance(y, u, filtered, 0.1); });
    EXPECT_TRUE((membrane.positions() == good.positions).all());
    EXPECT_TRUE((membrane.target_areas() == good.target_areas).all());
  }
}

TEST(Membrane, ARefusedStateChangesNothing) {
  const SphereGrid grid(8);
  Membrane membrane(prolate(grid, 0.9), 8, {});
  const MembraneState good = membrane.state();
  const auto refuse = [&](auto change) {
    MembraneState bad = good;
    bad.initial_volume *= 2;
    change(bad);
    EXPECT_ANY_THROW(membrane.restore(bad));
    EXPECT_TRUE((membrane.positions() == good.positions).all());
    EXPECT_EQ(membrane.initial_volume(), good.initial_volume);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  refuse([](MembraneState& s) { s.positions(5, 1) = nan; });
  refuse([](MembraneState& s) { s.positions.setZero(); });
  for (const double value : {0.0, -1.0, nan, infinity}) {
    refuse([value](MembraneState& s) { s.target_areas[7] = value; });
    refuse([value](MembraneState& s) { s.initial_areas[7] = value; });
    refuse([value](MembraneState& s) { s.initial_volume = value; });
  }
}

}  // namespace
}  // namespace vesiflow::vesicle::membrane_test
