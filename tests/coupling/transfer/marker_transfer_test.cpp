// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/marker_transfer.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <random>

#include "coupling/errors.h"

namespace vesiflow::coupling::marker_transfer_test {
namespace {

using vesicle::ScalarField;
using vesicle::VectorField;

const fluid::Grid grid({-1.0, -2.0, 0.0}, {2.0, 1.5, 2.5}, {19, 24, 17});

VectorField random_markers(int count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  VectorField x(count, 3);
  for (int m = 0; m < count; ++m)
    for (int axis = 0; axis < 3; ++axis) {
      const double margin = 2.0 * grid.spacing(axis);
      x(m, axis) = grid.lower[axis] + margin + unit(generator) * (grid.length(axis) - 2.0 * margin);
    }
  return x;
}

template <class Field, class Function>
void sample(Field& field, const Function& function) {
  for (int k = 0; k < field.extent(2); ++k)
    for (int j = 0; j < field.extent(1); ++j)
      for (int i = 0; i < field.extent(0); ++i) field(i, j, k) = function(field.position(i, j, k));
}

template <class Field>
void randomise(Field& field, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  sample(field, [&](const fluid::Vector3&) { return normal(generator); });
}

template <class Field>
double dot(const Field& a, const Field& b) {
  double sum = 0.0;
  for (int k = 0; k < a.extent(2); ++k)
    for (int j = 0; j < a.extent(1); ++j)
      for (int i = 0; i < a.extent(0); ++i) sum += a(i, j, k) * b(i, j, k);
  return sum;
}

template <class Field>
double sum_of(const Field& a) {
  double sum = 0.0;
  for (int k = 0; k < a.extent(2); ++k)
    for (int j = 0; j < a.extent(1); ++j)
      for (int i = 0; i < a.extent(0); ++i) sum += a(i, j, k);
  return sum;
}

TEST(MarkerTransfer, SpreadAndInterpolateAreDiscreteAdjoints) {
  std::mt19937 generator(11);
  MarkerTransfer transfer(grid);
  const VectorField markers = random_markers(300);
  transfer.update(markers);
  const VectorField force = VectorField::Random(300, 3);
  const ScalarField areas = ScalarField::Random(300).abs() + 0.1;
  fluid::FaceVector u(grid), density(grid);
  randomise(u.x, generator);
  randomise(u.y, generator);
  randomise(u.z, generator);
  transfer.spread(force, areas, density);
  VectorField velocity = VectorField::Zero(300, 3);
  transfer.interpolate(u, velocity);
  const double on_grid = (dot(density.x, u.x) + dot(density.y, u.y) + dot(density.z, u.z)) * grid.cell_volume();
  const double on_markers = ((force * velocity).rowwise().sum() * areas).sum();
  EXPECT_NEAR(on_grid, on_markers, 1e-12 * std::abs(on_markers) + 1e-12);
}

TEST(MarkerTransfer, SpreadingKeepsForceAndTorque) {
  MarkerTransfer transfer(grid);
  const VectorField markers = random_markers(50), force = VectorField::Random(50, 3);
  const ScalarField areas = ScalarField::Random(50).abs() + 0.1;
  transfer.update(markers);
  fluid::FaceVector density(grid);
  transfer.spread(force, areas, density);
  const double volume = grid.cell_volume();
  for (int c = 0; c < 3; ++c) {
    const double total = c == 0 ? sum_of(density.x) : c == 1 ? sum_of(density.y) : sum_of(density.z);
    EXPECT_NEAR(total * volume, (force.col(c) * areas).sum(), 1e-12);
  }
  // z component of the torque: the kernel's first moment vanishes.
  fluid::FaceVector arm(grid);
  sample(arm.x, [](const fluid::Vector3& x) { return -x[1]; });
  sample(arm.y, [](const fluid::Vector3& x) { return x[0]; });
  const double torque = (dot(density.x, arm.x) + dot(density.y, arm.y)) * volume;
  EXPECT_NEAR(torque, ((markers.col(0) * force.col(1) - markers.col(1) * force.col(0)) * areas).sum(), 1e-12);
}

TEST(MarkerTransfer, InterpolatesLinearFieldsExactly) {
  MarkerTransfer transfer(grid);
  const VectorField markers = random_markers(100);
  transfer.update(markers);
  fluid::FaceVector u(grid);
  const auto linear = [](const fluid::Vector3& x) { return 0.3 + 1.7 * x[0] - 0.9 * x[1] + 0.4 * x[2]; };
  sample(u.x, linear);
  sample(u.y, [&](const fluid::Vector3& x) { return 2.0 * linear(x); });
  sample(u.z, [&](const fluid::Vector3& x) { return -linear(x); });
  VectorField velocity = VectorField::Zero(100, 3);
  transfer.interpolate(u, velocity);
  for (int m = 0; m < 100; ++m) {
    const double exact = linear({markers(m, 0), markers(m, 1), markers(m, 2)});
    EXPECT_NEAR(velocity(m, 0), exact, 2e-14);
    EXPECT_NEAR(velocity(m, 1), 2.0 * exact, 4e-14);
    EXPECT_NEAR(velocity(m, 2), -exact, 2e-14);
  }
}

TEST(MarkerTransfer, ClearRemovesAllThatWasSpread) {
  MarkerTransfer transfer(grid);
  const VectorField force = VectorField::Random(40, 3);
  const ScalarField areas = ScalarField::Ones(40);
  fluid::FaceVector density(grid);
  const VectorField markers = random_markers(40);
  transfer.update(markers);
  transfer.spread(force, areas, density);
  ASSERT_GT(dot(density.x, density.x), 0.0);
  VectorField elsewhere = markers;
  elsewhere.col(0) = 0.5;
  transfer.update(elsewhere);  // new weights must not confuse what is to be cleared
  transfer.clear(density);
  EXPECT_EQ(dot(density.x, density.x) + dot(density.y, density.y) + dot(density.z, density.z), 0.0);
}

TEST(MarkerTransfer, GivesTheSameBitsForEveryNumberOfThreads) {
  const int threads_before = omp_get_max_threads();
  const VectorField markers = random_markers(500), force = VectorField::Random(500, 3);
  const ScalarField areas = ScalarField::Random(500).abs();
  const auto spread_with = [&](int threads) {
    omp_set_num_threads(threads);
    MarkerTransfer transfer(grid);
    transfer.update(markers);
    fluid::FaceVector density(grid);
    transfer.spread(force, areas, density);
    return density;
  };
  const fluid::FaceVector one = spread_with(1), three = spread_with(3);
  omp_set_num_threads(threads_before);
  EXPECT_TRUE(std::equal(one.x.data(), one.x.data() + one.x.size(), three.x.data()));
  EXPECT_TRUE(std::equal(one.y.data(), one.y.data() + one.y.size(), three.y.data()));
  EXPECT_TRUE(std::equal(one.z.data(), one.z.data() + one.z.size(), three.z.data()));
}

TEST(MarkerTransfer, RefusesMarkersAtWallsAndNonFiniteOnes) {
  MarkerTransfer transfer(grid);
  VectorField markers = random_markers(3);
  markers(1, 2) = grid.upper[2] - grid.spacing(2);
  EXPECT_THROW(transfer.update(markers), SimulationStopped);
  markers(1, 2) = std::nan("");
  EXPECT_THROW(transfer.update(markers), SimulationStopped);
}

// Arrays of a wrong size would be read and written out of their bounds.
TEST(MarkerTransfer, ArraysOfAWrongSizeAreRefused) {
  const int markers = 300;
  MarkerTransfer transfer(grid);
  const fluid::Grid other({-1.0, -2.0, 0.0}, {2.0, 1.5, 2.5}, {19, 24, 16});
  fluid::FaceVector field(grid), on_other_grid(other);
  VectorField vectors = VectorField::Zero(markers, 3), few_vectors = VectorField::Zero(markers - 1, 3);
  const ScalarField areas = ScalarField::Ones(markers), few_areas = ScalarField::Ones(markers - 1);
  EXPECT_THROW(transfer.spread(vectors, areas, field), std::invalid_argument) << "before any update";
  transfer.update(random_markers(markers));
  EXPECT_NO_THROW(transfer.spread(vectors, areas, field));
  EXPECT_THROW(transfer.spread(few_vectors, areas, field), std::invalid_argument);
  EXPECT_THROW(transfer.spread(vectors, few_areas, field), std::invalid_argument);
  EXPECT_THROW(transfer.spread(vectors, areas, on_other_grid), std::invalid_argument);
  EXPECT_THROW(transfer.clear(on_other_grid), std::invalid_argument);
  EXPECT_NO_THROW(transfer.interpolate(field, vectors));
  EXPECT_THROW(transfer.interpolate(field, few_vectors), std::invalid_argument);
  EXPECT_THROW(transfer.interpolate(on_other_grid, vectors), std::invalid_argument);
  VectorField outside = random_markers(markers);
  outside(7, 1) = 10.0;
  EXPECT_THROW(transfer.update(outside), SimulationStopped);
  EXPECT_THROW(transfer.interpolate(field, vectors), std::invalid_argument) << "after an update that was refused";
}

}  // namespace
}  // namespace vesiflow::coupling::marker_transfer_test
