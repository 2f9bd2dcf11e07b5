// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/resampling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/navier_stokes.h"
#include "fluid/operators.h"

namespace vesiflow::fluid::resampling_test {
namespace {

constexpr double untouched = 77.0;

Vector3 linear(const Vector3& r) {
  return {1 + 2 * r[0] - r[1] + 0.5 * r[2], r[0] + 3 * r[2], 2 - r[0] + r[1] - 2 * r[2]};
}

// Ghosts included.
template <class FieldType>
void fill(FieldType& field, int component, Vector3 (*function)(const Vector3&)) {
  for (int k = -1; k <= field.extent(2); ++k)
    for (int j = -1; j <= field.extent(1); ++j)
      for (int i = -1; i <= field.extent(0); ++i) field(i, j, k) = function(field.position(i, j, k))[component];
}

template <class FieldType>
void expect_inside_of(const Grid& box, const FieldType& field, int component) {
  for (int k = 0; k < field.extent(2); ++k)
    for (int j = 0; j < field.extent(1); ++j)
      for (int i = 0; i < field.extent(0); ++i) {
        const Vector3 r = field.position(i, j, k);
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis)
          inside = inside && r[axis] > box.lower[axis] - 1e-9 && r[axis] < box.upper[axis] + 1e-9;
        if (inside)
          ASSERT_NEAR(field(i, j, k), linear(r)[component], 1e-13) << i << " " << j << " " << k;
        else
          ASSERT_EQ(field(i, j, k), untouched) << i << " " << j << " " << k;
      }
}

TEST(Resampling, IsExactForLinearFieldsAndLeavesWhatIsOutside) {
  const Grid from({-1, -1, -1}, {1, 1.5, 1}, {8, 10, 7});
  FaceVector u(from);
  Field<Cell> p(from);
  fill(u.x, 0, linear);
  fill(u.y, 1, linear);
  fill(u.z, 2, linear);
  fill(p, 0, linear);
  for (const Grid& to :
       {Grid({-1, -1, -1}, {1, 1.5, 1}, {12, 15, 11}), Grid({-1, -1, -1}, {1, 1.5, 1}, {8, 10, 7}),
        Grid({-2, -1, -1.5}, {2, 2, 1.5}, {9, 8, 13}), Grid({-0.5, -0.5, -0.5}, {0.5, 1, 0.5}, {5, 5, 5})}) {
    FaceVector v(to);
    Field<Cell> q(to);
    v.fill(untouched);
    q.fill(untouched);
    resample(u, v);
    resample(p, q);
    expect_inside_of(from, v.x, 0);
    expect_inside_of(from, v.y, 1);
    expect_inside_of(from, v.z, 2);
    expect_inside_of(from, q, 0);
  }
}

TEST(Resampling, OnTheSameGridChangesNothing) {
  const Grid grid({-3, -1, 0}, {3, 1, 0.7}, {11, 9, 7}, {.periodic = {true, false, false}});
  FaceVector u(grid), v(grid);
  double value = 0.0;
  for (View component : u.points())
    for (int k = 0; k < component.extent[2]; ++k)
      for (int j = 0; j < component.extent[1]; ++j)
        for (int i = 0; i < component.extent[0]; ++i) component(i, j, k) = std::sin(value += 1.0);
  resample(u, v);
  for (int axis = 0; axis < 3; ++axis) {
    const ConstView a = std::as_const(u).points()[axis], b = std::as_const(v).points()[axis];
    for (int k = 0; k < a.extent[2]; ++k)
      for (int j = 0; j < a.extent[1]; ++j)
        for (int i = 0; i < a.extent[0]; ++i) ASSERT_EQ(a(i, j, k), b(i, j, k));
  }
}

TEST(Resampling, AFluidStartsFromTheDivergenceFreePart) {
  const Grid grid({-1, -1, -1}, {1, 1, 1}, {8, 9, 10});
  const auto at_rest = [](const Vector3&, double) { return Vector3{0, 0, 0}; };
  NavierStokes fluid(grid, FluidParameters{}, at_rest);
  FaceVector u(grid);
  Field<Cell> p(grid);
  fill(u.x, 0, linear);
  fill(u.y, 1, linear);
  fill(u.z, 2, linear);
  fill(p, 0, linear);
  fluid.step(0.1);
  fluid.start_from(u, p);
  EXPECT_LT(max_divergence(fluid.velocity()), 1e-12);
  EXPECT_EQ(fluid.time(), 0.0);
  EXPECT_EQ(fluid.steps(), 0);
  // The linear pressure less its mean, which is its value at the centre.
  const Field<Cell>& pressure = fluid.pressure();
  EXPECT_NEAR(pressure(1, 2, 3), linear(pressure.position(1, 2, 3))[0] - 1.0, 1e-13);
  u.y(2, 3, 4) = std::nan("");
  EXPECT_THROW(fluid.start_from(u, p), std::invalid_argument);
  const Grid other({-1, -1, -1}, {1, 1, 1}, {8, 9, 11});
  EXPECT_THROW(fluid.start_from(FaceVector(other), Field<Cell>(other)), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::fluid::resampling_test
