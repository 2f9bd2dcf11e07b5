#include "vesicle/resampling.h"

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle {
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

}  // namespace
}  // namespace vesiflow::vesicle
