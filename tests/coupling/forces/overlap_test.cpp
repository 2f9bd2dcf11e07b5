// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"

namespace vesiflow::coupling::overlap_test {
namespace {

using vesicle::Vector3;
using vesicle::VectorField;

vesicle::Surface sphere_at(const Vector3& centre, double radius = 1.0) {
  const vesicle::SphereGrid grid(16);
  vesicle::Placement placement;
  placement.centre = centre;
  placement.effective_radius = radius;
  vesicle::Surface surface(grid);
  surface.update(vesicle::sphere(grid, placement));
  return surface;
}

std::vector<double> distances(const fluid::Grid& grid, const std::vector<VectorField>& membranes) {
  std::vector<const VectorField*> pointers;
  for (const VectorField& m : membranes) pointers.push_back(&m);
  return nearest_distances(grid, pointers);
}

TEST(Overlap, IsAMarkerInsideOrOnTheSurface) {
  const vesicle::Surface unit = sphere_at({0, 0, 0});
  EXPECT_TRUE(overlap(unit, sphere_at({1.9, 0.1, 0}).positions()));
  EXPECT_TRUE(overlap(unit, unit.positions()));
  EXPECT_TRUE(overlap(unit, sphere_at({0.2, 0, 0}, 0.3).positions()));
  EXPECT_FALSE(overlap(unit, sphere_at({2.3, 0, 0}).positions()));
  EXPECT_FALSE(overlap(unit, sphere_at({1.5, 1.5, 0}).positions()));  // their bounds meet
  EXPECT_TRUE(overlap(unit, sphere_at({6.3, 0, 0}).positions(), {-5, 0, 0}));
}

// Against all pairs of markers and all images.
TEST(NearestDistances, AreThoseOfTheNearestImages) {
  const fluid::Grid grid({0, 0, 0}, {4, 5, 9}, {8, 8, 8}, {true, true, false});
  const std::vector<VectorField> membranes{sphere_at({1, 1, 2}, 0.7).positions(),
                                           sphere_at({3.2, 4.7 + 10, 3}, 0.8).positions(),
                                           sphere_at({-38, 2, 6.5}, 0.9).positions()};
  const std::vector<double> found = distances(grid, membranes);
  for (std::size_t a = 0; a < 3; ++a) {
    double nearest = 1e300;
    for (std::size_t b = 0; b < 3; ++b)
      for (int i = -11; i <= 11; ++i)
        for (int j = -4; j <= 4; ++j) {
          if (a == b && i == 0 && j == 0) continue;
          for (Eigen::Index m = 0; m < membranes[a].rows(); m += 1) {
            const Vector3 x = membranes[a].row(m).matrix().transpose() - Vector3(4.0 * i, 5.0 * j, 0.0);
            nearest =
                std::min(nearest, (membranes[b].rowwise() - x.transpose().array()).square().rowwise().sum().minCoeff());
          }
        }
    EXPECT_NEAR(found[a], std::sqrt(nearest), 1e-12) << a;
  }
}

TEST(NearestDistances, OfOneVesicleBetweenWallsAreInfinite) {
  const fluid::Grid grid({-3, -3, -3}, {3, 3, 3}, {8, 8, 8});
  EXPECT_TRUE(std::isinf(distances(grid, {sphere_at({0, 0, 0}).positions()})[0]));
}

}  // namespace
}  // namespace vesiflow::coupling::overlap_test
