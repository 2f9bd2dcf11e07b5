// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/field.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>

#include "fluid/operators.h"
#include "test_fields.h"

namespace vesiflow::fluid::field_test {
namespace {

const Grid grid({0.0, -1.0, 0.0}, {1.0, 1.0, 3.0}, {5, 4, 6});

static_assert(!std::is_copy_constructible_v<Field<Cell>> && std::is_nothrow_move_constructible_v<Field<Cell>>);
static_assert(!std::is_assignable_v<Field<FaceX>&, Field<FaceY>> && !std::is_convertible_v<Field<FaceX>, Field<Cell>>);
static_assert(!std::is_invocable_v<decltype(divergence), const FaceVector&, Field<FaceX>&>);
static_assert(std::is_convertible_v<View, ConstView> && !std::is_convertible_v<ConstView, View>);

TEST(Field, ExtentsCountTheFacesOnBothWalls) {
  EXPECT_EQ(Field<Cell>(grid).extent(), (std::array{5, 4, 6}));
  EXPECT_EQ(Field<FaceX>(grid).extent(), (std::array{6, 4, 6}));
  EXPECT_EQ(Field<FaceY>(grid).extent(), (std::array{5, 5, 6}));
  EXPECT_EQ(Field<FaceZ>(grid).extent(), (std::array{5, 4, 7}));
}

TEST(Field, PositionsOfFacesStartOnTheWall) {
  const Field<FaceY> field(grid);
  EXPECT_DOUBLE_EQ(field.position(0, 0, 0)[0], 0.1);
  EXPECT_DOUBLE_EQ(field.position(0, 0, 0)[1], -1.0);
  EXPECT_DOUBLE_EQ(field.position(0, 4, 0)[1], 1.0);
  EXPECT_DOUBLE_EQ(field.position(0, 0, -1)[2], -0.25);
}

TEST(Field, IndexingCoversTheGhostsAndEachNumberOnce) {
  Field<FaceZ> field(grid);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.data()) % 64, 0u);
  EXPECT_EQ(&field(-1, -1, -1), field.data());
  EXPECT_EQ(&field(5, 4, 7), field.data() + field.size() - 1);
  EXPECT_EQ(&field(1, 2, 3), &field(0, 0, 0) + field.stride(0) + 2 * field.stride(1) + 3 * field.stride(2));
  EXPECT_EQ(&field(1, 2, 3), &field.points()(1, 2, 3));
}

TEST(Field, UnknownsLeaveOutTheWalls) {
  Field<FaceY> field(grid);
  EXPECT_EQ(field.unknowns().extent, (std::array{5, 3, 6}));
  EXPECT_EQ(&field.unknowns()(0, 0, 0), &field(0, 1, 0));
  Field<Cell> cells(grid);
  EXPECT_EQ(&cells.unknowns()(0, 0, 0), &cells(0, 0, 0));
}

TEST(Field, CloneIsEqualAndApart) {
  FaceVector a = test::random_velocity(grid, 3);
  const FaceVector b = a.clone();
  EXPECT_TRUE(test::same_bits(a, b));
  a.z(2, 2, 2) += 1.0;
  EXPECT_FALSE(test::same_bits(a, b));
}

}  // namespace
}  // namespace vesiflow::fluid::field_test
