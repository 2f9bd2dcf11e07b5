// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "forces/close_pairs.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "support/allocation_counter.h"

namespace vesiflow::coupling::close_pairs_test {
namespace {

using vesicle::Vector3;
using vesicle::VectorField;

VectorField cloud(Eigen::Index markers, const Vector3& centre, const Vector3& extent, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  VectorField x(markers, 3);
  for (Eigen::Index m = 0; m < markers; ++m)
    for (int axis = 0; axis < 3; ++axis) x(m, axis) = centre(axis) + extent(axis) * unit(generator);
  return x;
}

using Found = std::map<std::pair<Eigen::Index, Eigen::Index>, double>;

Found all_pairs(const VectorField& a, const VectorField& b, const Vector3& shift, double range) {
  Found found;
  for (Eigen::Index m = 0; m < a.rows(); ++m)
    for (Eigen::Index n = 0; n < b.rows(); ++n) {
      const double distance = ((a.row(m) - b.row(n)).matrix().transpose() - shift).norm();
      if (distance > 0.0 && distance < range) found[{m, n}] = distance;
    }
  return found;
}

void expect_all(ClosePairs& pairs, const VectorField& a, const VectorField& b, const Vector3& shift, double range) {
  Found found;
  pairs.visit(a, Bounds(a), b, Bounds(b), shift,
              [&](Eigen::Index m, Eigen::Index n, const Vector3& r, double distance) {
                EXPECT_TRUE(found.insert({{m, n}, distance}).second) << "twice: " << m << ", " << n;
                EXPECT_EQ(r.norm(), distance);
                EXPECT_LT((r - ((a.row(m) - b.row(n)).matrix().transpose() - shift)).norm(), 1e-14);
              });
  const Found expected = all_pairs(a, b, shift, range);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [pair, distance] : expected) {
    ASSERT_TRUE(found.contains(pair)) << pair.first << ", " << pair.second;
    EXPECT_NEAR(found.at(pair), distance, 1e-14);
  }
}

// Clouds that overlap, touch, lie apart, are flat or one point: every pair nearer than the range, once.
TEST(ClosePairs, AreThoseOfAComparisonOfAll) {
  const std::vector<std::pair<Vector3, Vector3>> shapes{{{0, 0, 0}, {1, 1, 1}},
                                                        {{1.5, 0.2, -0.3}, {0.7, 1.1, 0.5}},
                                                        {{0.3, 0, 0}, {1, 0, 1}},
                                                        {{0.2, 0.1, 0}, {0, 0, 0}}};
  for (const double range : {0.05, 0.3, 5.0}) {
    ClosePairs pairs(range, 220);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t j = 0; j < shapes.size(); ++j) {
        SCOPED_TRACE(testing::Message() << "range " << range << ", shapes " << i << ", " << j);
        const VectorField a = cloud(220, shapes[i].first, shapes[i].second, 1);
        const VectorField b = cloud(150, shapes[j].first, shapes[j].second, 2);
        expect_all(pairs, a, b, Vector3::Zero(), range);
        expect_all(pairs, a, b, {0.4, -0.9, 0.2}, range);
      }
  }
}

TEST(ClosePairs, OfFarApartMembranesAreNone) {
  ClosePairs pairs(0.5, 100);
  const VectorField a = cloud(100, {0, 0, 0}, {1, 1, 1}, 3);
  pairs.visit(a, Bounds(a), a, Bounds(a), {10, 0, 0}, [](auto...) { FAIL(); });
}

// The markers of a membrane and its image by zero periods: a marker is no neighbour of itself.
TEST(ClosePairs, LeaveOutAMarkerWithItself) {
  ClosePairs pairs(0.6, 100);
  const VectorField a = cloud(100, {0, 0, 0}, {1, 1, 1}, 4);
  expect_all(pairs, a, a, Vector3::Zero(), 0.6);
}

TEST(ClosePairs, AllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  ClosePairs pairs(0.3, 200);
  const VectorField a = cloud(200, {0, 0, 0}, {1, 1, 1}, 5), b = cloud(200, {0.5, 0, 0}, {1, 1, 1}, 6);
  const Bounds bounds_a(a), bounds_b(b);
  long visits = 0;
  const long before = test::allocation_count();
  pairs.visit(a, bounds_a, b, bounds_b, Vector3::Zero(), [&](auto...) { ++visits; });
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_GT(visits, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::close_pairs_test
