// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/resampling.h"

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::resampling_test {
namespace {

TEST(Resampling, UpAndDownAreInverse) {
  const SphereGrid coarse(12), fine(31, 70);
  const VectorField x = testing::smooth_vector(coarse, 12, 3);
  VectorField up(fine.size(), 3), down(coarse.size(), 3);
  Resampling(coarse, fine).apply(x, up);
  Resampling(fine, coarse).apply(up, down);
  EXPECT_LT((down - x).abs().maxCoeff(), 1e-13);
}

/// Downwards it is the projection: what is left out is orthogonal to what is kept.
TEST(Resampling, DownIsTheProjection) {
  const SphereGrid fine(24), coarse(10);
  const Coefficients all = testing::random_coefficients(24, 1, 4);
  ScalarField values(fine.size()), projected(coarse.size());
  SphericalHarmonics(24, fine).synthesis(all, values);
  Resampling(fine, coarse).apply(values, projected);
  Coefficients kept;
  SphericalHarmonics(10, coarse).analysis(projected, kept);
  for (int n = 0; n < 10; ++n)
    for (int m = 0; m <= n; ++m) EXPECT_LT(std::abs(kept(0, n, m) - all(0, n, m)), 1e-13);
}

TEST(Resampling, RefusesWrongSizes) {
  const Resampling resampling(SphereGrid(8), SphereGrid(12));
  ScalarField result(resampling.to().size());
  EXPECT_THROW(resampling.apply(ScalarField::Zero(3), result), std::invalid_argument);
  ScalarField short_result(3);
  EXPECT_THROW(resampling.apply(ScalarField::Zero(resampling.from().size()), short_result), std::invalid_argument);
}

// The strain goes with the material: 0.1 z^2 of an ellipsoid is that on any mesh, but for the mean that keeps the totals.
TEST(Resampling, AMembraneKeepsItsErrorsAndItsStrain) {
  const SphereGrid coarse(16), fine(26);
  MembraneParameters parameters;
  parameters.strain_relaxation = 0.25;
  Membrane membrane(ellipsoid(coarse, Vector3(1.3, 1.0, 0.8)), coarse.latitudes(), parameters);
  MembraneState state = membrane.state();
  const auto bulge = [](const VectorField& x) { return ScalarField(0.1 * x.col(2).square()); };
  state.target_areas *= (-bulge(state.positions)).exp();
  state.initial_areas *= 1.01;
  state.initial_volume *= 0.99;
  state.lagged_strain = bulge(state.positions);
  const MembraneState refined = resample(state, coarse, fine);

  Membrane on_fine(refined.positions, fine.latitudes(), parameters);
  on_fine.restore(refined);
  EXPECT_NEAR(on_fine.surface().area(), membrane.surface().area(), 1e-7);
  EXPECT_NEAR(on_fine.initial_area(), 1.01 * membrane.initial_area(), 1e-12);
  EXPECT_EQ(on_fine.initial_volume(), state.initial_volume);
  EXPECT_NEAR(refined.target_areas.sum(), state.target_areas.sum(), 1e-12);
  EXPECT_LT((refined.lagged_strain - bulge(refined.positions)).abs().maxCoeff(), 1e-13);
  const ScalarField rest = (on_fine.surface().area_weight() / refined.target_areas).log() - bulge(refined.positions);
  EXPECT_LT((rest - rest.mean()).abs().maxCoeff(), 1e-12);
  EXPECT_NEAR(rest.mean(), 0.0, 1e-7);

  const MembraneState back = resample(refined, fine, coarse);
  EXPECT_LT((back.positions - state.positions).abs().maxCoeff(), 1e-13);
  EXPECT_LT((back.target_areas - state.target_areas).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(back.integral_tension.size(), 0);
  const MembraneState same = resample(state, coarse, coarse);
  EXPECT_TRUE((same.positions == state.positions).all());
  EXPECT_TRUE((same.target_areas == state.target_areas).all());
}

}  // namespace
}  // namespace vesiflow::vesicle::resampling_test
