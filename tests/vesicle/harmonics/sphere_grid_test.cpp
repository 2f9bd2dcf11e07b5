// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/sphere_grid.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace vesiflow::vesicle::sphere_grid_test {
namespace {

using std::numbers::pi;

TEST(SphereGrid, NodesAndWeightsOfFivePointRule) {
  const SphereGrid grid(5);
  const double root = 2 * std::sqrt(10.0 / 7);
  const double outer = std::sqrt(5 + root) / 3;
  const double inner = std::sqrt(5 - root) / 3;
  EXPECT_NEAR(grid.cos_colatitude()[0], outer, 1e-16);
  EXPECT_NEAR(grid.cos_colatitude()[1], inner, 1e-16);
  EXPECT_NEAR(grid.cos_colatitude()[2], 0, 1e-16);
  EXPECT_NEAR(grid.cos_colatitude()[4], -outer, 1e-16);
  EXPECT_NEAR(grid.weight()[0], (322 - 13 * std::sqrt(70.0)) / 900, 1e-16);
  EXPECT_NEAR(grid.weight()[1], (322 + 13 * std::sqrt(70.0)) / 900, 1e-16);
  EXPECT_NEAR(grid.weight()[2], 128.0 / 225, 1e-16);
}

TEST(SphereGrid, IntegratesPolynomialsExactly) {
  for (int latitudes : {4, 7, 32, 128}) {
    const SphereGrid grid(latitudes);
    for (int degree = 0; degree < 2 * latitudes; ++degree) {
      const double exact = degree % 2 ? 0 : 2.0 / (degree + 1);
      EXPECT_NEAR((grid.weight() * grid.cos_colatitude().pow(degree)).sum(), exact, 2e-15)
          << latitudes << ' ' << degree;
    }
  }
}

TEST(SphereGrid, NodesAscendAndMirror) {
  const SphereGrid grid(33);
  for (int j = 0; j < 33; ++j) {
    EXPECT_GT(grid.colatitude()[j], j == 0 ? 0 : grid.colatitude()[j - 1]);
    EXPECT_EQ(grid.sin_colatitude()[j], grid.sin_colatitude()[32 - j]);
    EXPECT_EQ(grid.weight()[j], grid.weight()[32 - j]);
  }
}

TEST(SphereGrid, NumbersLongitudesFastest) {
  const SphereGrid grid(6);
  EXPECT_EQ(grid.size(), 72);
  EXPECT_EQ(grid.index(3, 2), 27);
  EXPECT_DOUBLE_EQ(grid.longitude(6), pi);
}

TEST(SphereGrid, RefusesTooFewLatitudes) {
  EXPECT_THROW(SphereGrid(1), std::invalid_argument);
  EXPECT_THROW(SphereGrid(8, 14), std::invalid_argument);
  EXPECT_THROW(SphereGrid(8, 17), std::invalid_argument);
}

TEST(SphereGrid, RefusesNumbersBeyondItsRange) {
  for (int latitudes : {std::numeric_limits<int>::min(), -5, 0, 1, 4097, std::numeric_limits<int>::max()})
    EXPECT_THROW(SphereGrid{latitudes}, std::invalid_argument) << latitudes;
  for (int longitudes : {-8, 6, 9, 16386, std::numeric_limits<int>::max()})
    EXPECT_THROW(SphereGrid(4, longitudes), std::invalid_argument) << longitudes;
}

}  // namespace
}  // namespace vesiflow::vesicle::sphere_grid_test
