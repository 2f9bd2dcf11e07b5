// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/integral_tension.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/membrane.h"
#include "vesicle/tension.h"

namespace vesiflow::vesicle::integral_tension_test {
namespace {

constexpr int latitudes = 20;

VectorField start() {
  return prolate(SphereGrid(latitudes), 0.9);
}

TEST(IntegralTension, SumsUpTheLowDegreesOfTheStrainOnly) {
  const SphereGrid grid(latitudes);
  IntegralTension integral(grid, {.rate = 3, .degrees = 5});
  const ScalarField low = testing::smooth_scalar(grid, 5, 1);
  Coefficients coefficients(9, 1);
  coefficients.set_zero();
  coefficients(0, 5, 2) = {1, 0.5};
  coefficients(0, 8, 0) = 1;
  ScalarField high(grid.size());
  SphericalHarmonics(9, grid).synthesis(coefficients, high);
  ScalarField multiplier = ScalarField::Constant(grid.size(), 0.25);
  integral.advance(low + high, 0.1, multiplier);
  integral.advance(low + high, 0.05, multiplier);
  EXPECT_LT((multiplier - 0.25 - 3 * 0.15 * low).abs().maxCoeff(), 1e-13);
}

/// With tension, bending and a multiplier that is anything but constant.
TEST(IntegralTension, ForceIsMinusTheGradientOfTheEnergyAtFixedMultiplier) {
  Membrane membrane(start(), latitudes, {.integral_tension = {.rate = 2}});
  MembraneState state = membrane.state();
  const SphereGrid& grid = membrane.surface().grid();
  const VectorField shape = start() * 1.01 + 0.01 * testing::smooth_vector(grid, 3, 91);
  state.positions = shape;
  state.integral_tension = 0.02 * testing::smooth_scalar(grid, 5, 93);
  membrane.restore(state);
  const VectorField force = membrane.compute_force();
  const VectorField direction = testing::smooth_vector(grid, 3, 92);
  const double power = testing::work(membrane.surface(), force, direction);
  const double slope = testing::directional_derivative(
      [&](const VectorField& x) {
        state.positions = x;
        membrane.restore(state);
        return membrane.energy();
      },
      shape, direction, 1e-3);
  EXPECT_NEAR(-power, slope, 1e-6 * std::abs(slope));
  // The multiplier has a part in that.
  state.positions = shape;
  state.integral_tension.setZero();
  membrane.restore(state);
  EXPECT_GT(std::abs(testing::work(membrane.surface(), membrane.compute_force(), direction) - power),
            1e-3 * std::abs(power));
}

TEST(IntegralTension, StepsAddTheStrainOfTheOldGeometry) {
  Membrane membrane(start(), latitudes, {.integral_tension = {.rate = 2, .degrees = 4}});
  const VectorField none = VectorField::Zero(membrane.positions().rows(), 3);
  constexpr double stretch = 1.01, dt = 0.1;
  membrane.advance(stretch * membrane.positions(), none, none, dt);
  EXPECT_EQ(membrane.integral_tension().abs().maxCoeff(), 0);
  membrane.update_geometry();
  membrane.advance(membrane.positions(), none, none, dt);
  EXPECT_LT((membrane.integral_tension() - dt * 2 * 2 * std::log(stretch)).abs().maxCoeff(), 1e-14);
}

TEST(IntegralTension, CostsNothingWhereThereIsNone) {
  for (const double sigma0 : {0.0, 100.0}) {
    Membrane membrane(start(), latitudes, {.sigma0 = sigma0, .integral_tension = {.rate = sigma0 == 0 ? 2.0 : 0.0}});
    EXPECT_EQ(membrane.state().integral_tension.size(), 0);
    EXPECT_EQ(membrane.state().lagged_strain.size(), 0);
  }
}

TEST(StrainRelaxation, TensionFollowsTheStrainGeometrically) {
  constexpr double a = 0.25, stretch = 1.01, sigma0 = 100;
  Membrane membrane(start(), latitudes, {.sigma0 = sigma0, .strain_relaxation = a});
  const VectorField none = VectorField::Zero(membrane.positions().rows(), 3);
  membrane.advance(stretch * membrane.positions(), none, none, 0.1);
  for (int k = 1; k < 6; ++k) {
    membrane.update_geometry();
    const double s = 2 * std::log(stretch) * (1 - std::pow(1 - a, k));
    membrane.compute_force();
    EXPECT_LT((membrane.tension() - sigma0 * s * std::exp(-s)).abs().maxCoeff(), 1e-12);
    membrane.compute_force();  // asking again changes nothing
    EXPECT_LT((membrane.tension() - sigma0 * s * std::exp(-s)).abs().maxCoeff(), 1e-12);
    membrane.advance(membrane.positions(), none, none, 0.1);
  }
}

/// Lagged strain and multiplier belong to the material: on another mesh they give the tension of the same places.
TEST(IntegralTension, RedistributionCarriesWhatTheTensionRemembers) {
  const SphereGrid grid(latitudes);
  const auto smooth = [](const VectorField& x) { return ScalarField(0.02 * (x.col(0) + x.col(1) * x.col(2))); };
  // A smooth map of the sphere's parameters, so that there is a better mesh.
  VectorField x = start();
  const VectorField skewed = testing::smooth_vector(grid, 3, 7);
  for (Eigen::Index k = 0; k < x.rows(); ++k) x.row(k) += 0.1 * skewed.row(k);
  Membrane membrane(x, latitudes, {.strain_relaxation = 0.5, .integral_tension = {.rate = 2}});
  MembraneState state = membrane.state();
  state.lagged_strain = smooth(x);
  state.integral_tension = -2 * smooth(x);
  membrane.restore(state);
  MeshRedistribution redistribution(latitudes);
  ASSERT_TRUE(membrane.redistribute(redistribution).moved);
  EXPECT_GT((membrane.positions() - x).abs().maxCoeff(), 0.01);
  const MembraneState after = membrane.state();
  EXPECT_LT((after.lagged_strain - smooth(after.positions)).abs().maxCoeff(), 1e-5);
  EXPECT_LT((after.integral_tension + 2 * smooth(after.positions)).abs().maxCoeff(), 1e-5);
}

TEST(IntegralTension, StatesOfOtherMembranesAreRefused) {
  Membrane with(start(), latitudes, {.strain_relaxation = 0.5, .integral_tension = {.rate = 2}});
  Membrane without(start(), latitudes, {});
  EXPECT_THROW(without.restore(with.state()), std::invalid_argument);
  EXPECT_THROW(with.restore(without.state()), std::invalid_argument);
  MembraneState state = with.state();
  state.integral_tension[3] = NAN;
  EXPECT_THROW(with.restore(state), std::invalid_argument);
}

TEST(IntegralTension, RefusesBadArguments) {
  const SphereGrid grid(8);
  EXPECT_THROW(IntegralTension(grid, {.rate = -1}), std::invalid_argument);
  EXPECT_THROW(IntegralTension(grid, {.rate = INFINITY}), std::invalid_argument);
  EXPECT_THROW(IntegralTension(grid, {.rate = 1, .degrees = 0}), std::invalid_argument);
  EXPECT_THROW(Membrane(start(), latitudes, {.strain_relaxation = 0}), std::invalid_argument);
  EXPECT_THROW(Membrane(start(), latitudes, {.strain_relaxation = 1.5}), std::invalid_argument);
  IntegralTension integral(grid, {.rate = 1});
  ScalarField multiplier = ScalarField::Zero(grid.size());
  testing::expect_refused_if_not_finite(ScalarField(multiplier),
                                        [&](const ScalarField& s) { integral.advance(s, 1, multiplier); });
  EXPECT_EQ(multiplier.abs().maxCoeff(), 0);
  EXPECT_THROW(integral.advance(ScalarField::Zero(3), 1, multiplier), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::integral_tension_test
