// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/indicator.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>

#include "indicator_cases.h"
#include "support/allocation_counter.h"

namespace vesiflow::coupling::indicator_test {
namespace {

using test::indicator_errors;
using test::IndicatorErrors;
using test::SolidEllipsoid;

using Field = fluid::Field<fluid::Cell>;

const SolidEllipsoid ellipsoid{{0.7, 1.0, 1.6}, {0.03, 0.02, -0.04}};

fluid::Grid box(int cells, const std::array<bool, 3>& periodic = {false, false, false}) {
  return {{-3, -3, -3}, {3, 3, 3}, {cells, cells, cells}, {.periodic = periodic}};
}

Field indicator_of(const fluid::Grid& grid, const vesicle::Surface& surface, double value = 1.0) {
  Field field(grid);
  Indicator indicator(grid, 1);
  indicator.add(0, surface, value);
  indicator.solve(field);
  return field;
}

double sum_of(const Field& field) {
  double sum = 0.0;
  for (int k = 0; k < field.extent(2); ++k)
    for (int j = 0; j < field.extent(1); ++j)
      for (int i = 0; i < field.extent(0); ++i) sum += field(i, j, k);
  return sum;
}

double greatest_difference(const Field& a, const Field& b) {
  double greatest = 0.0;
  for (int k = 0; k < a.extent(2); ++k)
    for (int j = 0; j < a.extent(1); ++j)
      for (int i = 0; i < a.extent(0); ++i) greatest = std::max(greatest, std::abs(a(i, j, k) - b(i, j, k)));
  return greatest;
}

// The constant is set by the volume; that it is the one for which the field vanishes at the walls, in the mean weighted with
// x.n, says that the equation itself has the right volume: no part of it may be missing.
TEST(Indicator, EquationKnowsTheVolume) {
  const fluid::Grid grid({-3, -2.5, -3}, {3, 3, 4}, {24, 20, 32});
  const Field field = indicator_of(grid, ellipsoid.surface(24));
  EXPECT_NEAR(sum_of(field) * grid.cell_volume() / ellipsoid.volume(), 1.0, 1e-12);
  double at_walls = 0.0;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 20; ++j)
      at_walls += (3.0 * field(23, j, k) + 3.0 * field(0, j, k)) * grid.spacing(1) * grid.spacing(2);
  for (int k = 0; k < 32; ++k)
    for (int i = 0; i < 24; ++i)
      at_walls += (3.0 * field(i, 19, k) + 2.5 * field(i, 0, k)) * grid.spacing(0) * grid.spacing(2);
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 24; ++i)
      at_walls += (4.0 * field(i, j, 31) + 3.0 * field(i, j, 0)) * grid.spacing(0) * grid.spacing(1);
  EXPECT_NEAR(at_walls, 0.0, 1e-10);
}

// Outside the delta functions the kernel's second moment sees a harmonic function: at least second order.
TEST(Indicator, ConvergesAwayFromTheMembrane) {
  for (const SolidEllipsoid& shape : {SolidEllipsoid{{1, 1, 1}, {0.03, 0.02, -0.04}}, ellipsoid}) {
    std::array<IndicatorErrors, 2> e;
    for (int i = 0; i < 2; ++i) {
      const int cells = i == 0 ? 24 : 48;
      const vesicle::Surface surface = shape.surface(cells);
      e[static_cast<std::size_t>(i)] = indicator_errors(indicator_of(box(cells), surface), shape, surface.area(), 0.75);
    }
    EXPECT_GT(std::log2(e[0].far / e[1].far), 1.9);
    EXPECT_LT(e[1].far, 2e-3);
    // The layer at the membrane is as wide as the delta function: of first order.
    EXPECT_NEAR(std::log2(e[0].mean / e[1].mean), 1.0, 0.1);
    EXPECT_LT(e[1].above, 0.05);
    EXPECT_LT(e[1].below, 0.05);
    EXPECT_LT(std::abs(e[1].limited_volume), 5e-3);
  }
}

TEST(Indicator, DirichletWallsMissTheVolume) {
  const vesicle::Surface surface = ellipsoid.surface(24);
  Field field(box(24));
  test::dirichlet_indicator(surface, field);
  const IndicatorErrors dirichlet = indicator_errors(field, ellipsoid, surface.area(), 0.75);
  const IndicatorErrors neumann = indicator_errors(indicator_of(box(24), surface), ellipsoid, surface.area(), 0.75);
  EXPECT_LT(std::abs(neumann.volume), 1e-12);
  EXPECT_GT(std::abs(dirichlet.volume), 1e-6);
}

TEST(Indicator, HardlyDependsOnWhereTheMembraneLiesInTheGrid) {
  const fluid::Grid grid = box(32);
  const double h = grid.spacing(0);
  double least = 1e300, greatest = 0.0;
  for (const double shift : {0.0, 0.25, 0.5, 0.8}) {
    const SolidEllipsoid shape{{0.7, 1.0, 1.6}, {shift * h, 0.7 * shift * h, -0.4 * shift * h}};
    const vesicle::Surface surface = shape.surface(32);
    const IndicatorErrors e = indicator_errors(indicator_of(grid, surface), shape, surface.area(), 0.75);
    least = std::min(least, e.mean);
    greatest = std::max(greatest, e.mean);
  }
  EXPECT_LT(greatest / least, 1.02);

  // By a whole cell it moves along exactly, but for what the walls send back.
  const SolidEllipsoid here{{0.7, 1.0, 1.6}, {0, 0, 0}}, there{{0.7, 1.0, 1.6}, {h, 0, 0}};
  const Field a = indicator_of(grid, here.surface(32)), b = indicator_of(grid, there.surface(32));
  double difference = 0.0;
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 31; ++i) difference = std::max(difference, std::abs(a(i, j, k) - b(i + 1, j, k)));
  EXPECT_LT(difference, 1e-3);
}

TEST(Indicator, OneSolveIsForAllMembranes) {
  const fluid::Grid grid = box(24);
  const SolidEllipsoid one{{0.6, 0.6, 0.8}, {-1.2, 0, 0}}, two{{0.7, 0.9, 0.7}, {1.1, 0.2, 0.1}};
  const vesicle::Surface first = one.surface(16), second = two.surface(20);
  Indicator indicator(grid, 3);
  Field both(grid);
  for (int repeated = 0; repeated < 2; ++repeated) {  // nothing is left of the time before
    indicator.add(0, first, 4.0);
    indicator.add(1, second, -0.5);
    indicator.solve(both);
  }
  const Field a = indicator_of(grid, first, 4.0), b = indicator_of(grid, second, -0.5);
  Field sum(grid);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 24; ++i) sum(i, j, k) = a(i, j, k) + b(i, j, k);
  EXPECT_LT(greatest_difference(both, sum), 1e-13);
  indicator.add(2, first, 0.0);
  indicator.solve(both);
  EXPECT_EQ(greatest_difference(both, Field(grid)), 0.0);
}

TEST(Indicator, HoldsForEveryMixOfWallsAndPeriodicAxes) {
  const vesicle::Surface surface = ellipsoid.surface(32);
  for (int mask = 0; mask < 8; ++mask) {
    const fluid::Grid grid = box(32, {(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0});
    const IndicatorErrors e = indicator_errors(indicator_of(grid, surface), ellipsoid, surface.area(), 0.75);
    EXPECT_LT(e.far, 5e-3) << mask;
    EXPECT_LT(std::abs(e.volume), 1e-12) << mask;
  }
}

TEST(Indicator, GivesTheSameBitsForEveryNumberOfThreadsAndAllocatesNothing) {
  const int before = omp_get_max_threads();
  const fluid::Grid grid = box(24);
  const vesicle::Surface surface = ellipsoid.surface(24);
  omp_set_num_threads(1);
  const Field one = indicator_of(grid, surface);
  omp_set_num_threads(3);
  const Field three = indicator_of(grid, surface);
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(double)), 0);
  omp_set_num_threads(before);
  if (!vesiflow::test::allocations_are_counted()) return;
  Indicator indicator(grid, 1);
  Field field(grid);
  const auto solve = [&] {
    indicator.add(0, surface, 1.0);
    indicator.solve(field);
  };
  solve();
  const long allocations = vesiflow::test::allocation_count();
  solve();
  EXPECT_EQ(vesiflow::test::allocation_count(), allocations);
}

TEST(Indicator, RefusesAFieldOnAnotherGrid) {
  const fluid::Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), other({0, 0, 0}, {1, 1, 1}, {8, 8, 4});
  Field field(other);
  EXPECT_THROW(Indicator(grid, 1).solve(field), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::indicator_test
