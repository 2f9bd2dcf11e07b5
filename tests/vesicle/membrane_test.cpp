#include "vesicle/membrane.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle {
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
}  // namespace vesiflow::vesicle
