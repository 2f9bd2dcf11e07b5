// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace vesiflow::fluid::grid_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Grid, SpacingsAreLengthsOverCells) {
  const Grid grid({-1.0, 0.0, 2.0}, {1.0, 3.0, 7.0}, {8, 6, 5});
  EXPECT_DOUBLE_EQ(grid.spacing(0), 0.25);
  EXPECT_DOUBLE_EQ(grid.spacing(1), 0.5);
  EXPECT_DOUBLE_EQ(grid.spacing(2), 1.0);
  EXPECT_DOUBLE_EQ(grid.min_spacing(), 0.25);
  EXPECT_DOUBLE_EQ(grid.cell_volume(), 0.125);
  EXPECT_EQ(grid.cell_count(), 240u);
}

TEST(Grid, RefusesAnEmptyBoxAndNamesTheAxis) {
  EXPECT_THAT(
      [] {
        Grid({0, 0, 0}, {1, -2.5, 1}, {8, 8, 8});
      },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("axis 1"), HasSubstr("-2.5"))));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Grid({0, 0, 0}, {1, 1, nan}, {8, 8, 8}), std::invalid_argument);
}

TEST(Grid, RefusesTooFewCellsAndNamesTheLeast) {
  EXPECT_THAT(
      [] {
        Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 3});
      },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("3 cells"), HasSubstr("at least 4"))));
}

TEST(Grid, HasWallsWhereItIsNeitherPeriodicNorMirrored) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {true, false, false}, .mirror = {false, false, true}});
  EXPECT_FALSE(grid.has_wall(0, 0) || grid.has_wall(0, 1));
  EXPECT_TRUE(grid.has_wall(1, 0) && grid.has_wall(1, 1));
  EXPECT_FALSE(grid.has_wall(2, 0));
  EXPECT_TRUE(grid.has_wall(2, 1));
  EXPECT_FALSE(grid == Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {true, false, false}}));
}

TEST(Grid, RefusesAPeriodicMirrorAndNamesTheAxis) {
  EXPECT_THAT(
      [] {
        Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}, {.periodic = {false, false, true}, .mirror = {false, false, true}});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("axis 2 is periodic and has a mirror")));
}

}  // namespace
}  // namespace vesiflow::fluid::grid_test
