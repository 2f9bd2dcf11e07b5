// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/fine_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/allocation_counter.h"
#include "transfer/ellipsoid.h"
#include "vesicle/point_evaluation.h"

namespace vesiflow::coupling::fine_surface_test {
namespace {

using test::Ellipsoid;
using Direction = FineSurface::Direction;

vesicle::Surface surface_of(const Ellipsoid& body, int latitudes) {
  vesicle::Surface surface(latitudes);
  surface.update(body.markers(surface.grid()));
  return surface;
}

Ellipsoid some_ellipsoid() {
  return {{0.8, 1.0, 1.3}, {0.2, -0.3, 0.1}};
}

std::vector<Direction> random_directions(int count) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<Direction> all;
  for (int k = 0; k < count; ++k) {
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    all.push_back(Direction(x, y, z).normalized());
  }
  return all;
}

/// The poles themselves, and points around them from the distance of round-off to that of some rows.
std::vector<Direction> directions_at_poles() {
  std::vector<Direction> all{{0, 0, 1}, {0, 0, -1}, {0.0, -0.0, 1}, {-0.0, 0.0, -1}};
  for (const double distance : {1e-300, 1e-17, 1e-12, 1e-6, 1e-3, 0.02, 0.1, 0.3})
    for (int k = 0; k < 16; ++k)
      for (const double pole : {1.0, -1.0}) {
        const double phi = (k + 0.3) * 0.4;
        all.push_back(Direction(distance * std::cos(phi), distance * std::sin(phi), pole).normalized());
      }
  return all;
}

/// Where longitudes begin and end.
std::vector<Direction> directions_at_the_seam() {
  std::vector<Direction> all;
  for (const double y : {0.0, -0.0, 1e-17, -1e-17, -1e-300, 1e-5, -1e-5})
    for (const double z : {-0.7, 0.0, 0.4}) all.push_back(Direction(1, y, z).normalized());
  return all;
}

// Between nodes, at the poles and where longitudes begin. Spacing 0.1 of a body of curvature of about 1: the sixth
// power of it times the denominators of Lagrange is below 1e-6; its derivatives grow at the tips.
TEST(FineSurface, HoldsAnEllipsoidBetweenNodes) {
  const Ellipsoid body = some_ellipsoid();
  const vesicle::Surface surface = surface_of(body, 40);
  FineSurface fine(1);
  fine.update(surface, 0.1);
  for (const auto& directions : {random_directions(400), directions_at_poles(), directions_at_the_seam()})
    for (const Direction& s : directions) {
      const FineSurface::Place place = fine.place_of(s);
      EXPECT_LT((Eigen::Vector3d(fine.value(place, FineSurface::position).head<3>()) - body.point(s)).norm(), 1e-5);
      EXPECT_LT((Eigen::Vector3d(fine.value(place, FineSurface::normal).head<3>()) - body.normal(s)).norm(), 1e-4);
    }
}

// Its own nodes are hit to round-off.
TEST(FineSurface, ReproducesItsNodes) {
  const vesicle::Surface surface = surface_of(some_ellipsoid(), 16);
  FineSurface fine(1);
  fine.update(surface, 0.2);
  for (int j = 0; j < fine.latitudes(); ++j)
    for (int i = 0; i < fine.longitudes(); ++i) {
      const FineSurface::Place place = fine.place_of(fine.mesh().direction_of({j, i}));
      for (int record = 0; record < FineSurface::jumps; ++record)
        EXPECT_LT((fine.value(place, record) - fine.at_node(i, j, record)).abs().maxCoeff(), 1e-11) << i << ' ' << j;
    }
}

// What says how far it is from one point to another: of single precision, and as exact as the surface's own.
TEST(FineSurface, HasItsSlopes) {
  const Ellipsoid body = some_ellipsoid();
  const vesicle::Surface surface = surface_of(body, 40);
  FineSurface fine(1);
  fine.update(surface, 0.1);
  for (int j = 0; j < fine.latitudes(); ++j)
    for (int i = 0; i < fine.longitudes(); i += 5) {
      const Direction s = fine.mesh().direction_of({j, i});
      const auto slopes = fine.at(FineSurface::Node{j, i}).slopes;
      const Eigen::Matrix3d gradient = body.direction_gradient(s), shape = body.shape(s);
      const double exact[15] = {gradient(0, 0), gradient(0, 1), gradient(0, 2), gradient(1, 0), gradient(1, 1),
                                gradient(1, 2), gradient(2, 0), gradient(2, 1), gradient(2, 2), shape(0, 0),
                                shape(1, 1),    shape(2, 2),    shape(0, 1),    shape(1, 2),    shape(2, 0)};
      for (int k = 0; k < 15; ++k) EXPECT_NEAR(slopes[k], exact[k], 1e-5) << j << ' ' << i << ' ' << k;
    }
}

// No two neighbours further apart than wished, also on a body that is long; and finer for one that stretches. A mesh that
// depended on the bodies before would not be that of a run that is restarted.
TEST(FineSurface, NodesAreAsCloseAsWished) {
  constexpr double spacing = 0.15;
  FineSurface fine(1);
  int before = 0, first = 0;
  for (const Eigen::Vector3d& axes : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0.7, 0.9, 1.6)}) {
    fine.update(surface_of(Ellipsoid(axes, {0, 0, 0}), 24), spacing);
    double farthest = 0.0;
    const auto node = [&](int i, int j) { return fine.at_node(i, j, FineSurface::position); };
    for (int j = 0; j < fine.latitudes(); ++j)
      for (int i = 0; i < fine.longitudes(); ++i) {
        farthest = std::max(farthest, (node(i, j) - node((i + 1) % fine.longitudes(), j)).matrix().norm());
        if (j > 0) farthest = std::max(farthest, (node(i, j) - node(i, j - 1)).matrix().norm());
      }
    EXPECT_LT(farthest, spacing);
    EXPECT_GT(farthest, 0.8 * spacing);
    EXPECT_GT(fine.latitudes(), before);
    EXPECT_EQ(fine.nodes(), fine.latitudes() * fine.longitudes());
    before = fine.latitudes();
    if (first == 0) first = before;
  }
  fine.update(surface_of(Ellipsoid({1, 1, 1}, {0, 0, 0}), 24), spacing);
  EXPECT_EQ(fine.latitudes(), first);
}

// Of as many degrees as the surface or less, in any order of slots; slots that nothing is set of stay zero.
TEST(FineSurface, HoldsFieldsOfTheCaller) {
  constexpr int degrees = 6;
  const std::vector<int> slots{0, 5, 2, 7, 3};
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  vesicle::Coefficients fields(degrees, static_cast<int>(slots.size()));
  for (int f = 0; f < fields.fields(); ++f)
    for (int n = 0; n < degrees; ++n)
      for (int m = 0; m <= n; ++m) fields(f, n, m) = {uniform(generator), m > 0 ? uniform(generator) : 0.0};

  const vesicle::Surface surface = surface_of(some_ellipsoid(), 20);
  std::vector<Direction> directions = random_directions(200);
  for (const auto& more : {directions_at_poles(), directions_at_the_seam()})
    directions.insert(directions.end(), more.begin(), more.end());
  vesicle::VectorField points(static_cast<Eigen::Index>(directions.size()), 3);
  for (std::size_t k = 0; k < directions.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = directions[k].transpose().array();
  Eigen::ArrayXXd exact(points.rows(), fields.fields());
  vesicle::PointEvaluation(degrees).values_at(fields, points, exact);

  std::array<double, 2> errors{};
  std::array<int, 2> latitudes{};
  for (std::size_t step = 0; step < 2; ++step) {
    FineSurface fine(2);
    fine.update(surface, step == 0 ? 0.2 : 0.1);
    fine.set(fields, slots);
    latitudes[step] = fine.latitudes();
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const FineSurface::Place place = fine.place_of(directions[k]);
      Eigen::Array<double, 8, 1> found, wanted;
      found << fine.value(place, FineSurface::jumps), fine.value(place, FineSurface::jumps + 1);
      wanted.setZero();
      for (std::size_t f = 0; f < slots.size(); ++f)
        wanted[slots[f]] = exact(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(f));
      errors[step] = std::max(errors[step], (found - wanted).abs().maxCoeff());
    }
  }
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_NEAR(std::log(errors[0] / errors[1]) / std::log(static_cast<double>(latitudes[1]) / latitudes[0]), 6.0, 0.5);
}

TEST(FineSurface, AllocatesNothingOnAMeshThatFits) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const vesicle::Surface surface = surface_of(some_ellipsoid(), 16),
                         moved = surface_of({{0.8, 1.0, 1.3}, {0, 0, 0}}, 16);
  vesicle::Coefficients fields(8, 4);
  fields.set_zero();
  const std::vector<int> slots{0, 1, 2, 3};
  FineSurface fine(1);
  fine.update(surface, 0.2);
  fine.set(fields, slots);
  const long before = vesiflow::test::allocation_count();
  fine.update(moved, 0.2);
  fine.set(fields, slots);
  EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::fine_surface_test
