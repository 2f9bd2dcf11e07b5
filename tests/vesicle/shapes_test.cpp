#include "vesicle/shapes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "vesicle/surface.h"

namespace vesiflow::vesicle {
namespace {

using std::numbers::pi;

TEST(Shapes, SpheroidsHitTheReducedVolume) {
  for (double v : {1e-3, 0.3, 0.6, 0.8, 0.95, 0.999, 1 - 1e-10, 1.0}) {
    EXPECT_NEAR(spheroid_reduced_volume(prolate_aspect_ratio(v)), v, 1e-12);
    EXPECT_NEAR(spheroid_reduced_volume(oblate_aspect_ratio(v)), v, 1e-12);
    EXPECT_GE(prolate_aspect_ratio(v), 1);
    EXPECT_LE(oblate_aspect_ratio(v), 1);
  }
}

/// Reference aspect ratios, c/a of prolates.
TEST(Shapes, AspectRatiosAgainstReference) {
  EXPECT_NEAR(prolate_aspect_ratio(0.975), 1.3733491471145063, 1e-10);
  EXPECT_NEAR(prolate_aspect_ratio(0.9), 1.9621762549176347, 1e-11);
  EXPECT_NEAR(prolate_aspect_ratio(0.8), 2.791386466405403, 1e-11);
  EXPECT_NEAR(spheroid_reduced_volume(1.0 / 3), 0.7103340305170204, 1e-15);
  EXPECT_NEAR(spheroid_reduced_volume(2.8), 0.7990751130622032, 1e-15);
}

TEST(Shapes, MeshesHaveTheReducedVolumeAndTheVolume) {
  Surface surface(64);
  for (double v : {0.7, 0.8, 0.9, 0.975}) {
    for (const VectorField& x : {prolate(surface.grid(), v, {.effective_radius = 1.5}),
                                 oblate(surface.grid(), v, {.effective_radius = 1.5})}) {
      surface.update(x);
      EXPECT_NEAR(reduced_volume(surface.area(), surface.volume()), v, 1e-11) << v;
      EXPECT_NEAR(surface.volume(), 4 * pi / 3 * std::pow(1.5, 3), 1e-11);
    }
  }
}

TEST(Shapes, ArePlaced) {
  const SphereGrid grid(16);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(0.4, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 centre(5, -3, 1);
  const VectorField plain = ellipsoid(grid, {1, 2, 3});
  const VectorField placed = ellipsoid(grid, {2, 4, 6}, {1, rotation, centre});
  const VectorField expected = ((rotation * plain.matrix().transpose()).colwise() + centre).transpose().array();
  EXPECT_LT((placed - expected).abs().maxCoeff(), 1e-14);
}

TEST(Shapes, RefuseBadArgumentsWithValueAndRange) {
  const SphereGrid grid(8);
  EXPECT_THROW(prolate(grid, 0), std::invalid_argument);
  EXPECT_THROW(oblate(grid, -0.5), std::invalid_argument);
  EXPECT_THROW(oblate(grid, std::nan("")), std::invalid_argument);
  EXPECT_THROW(prolate(grid, 1e-300), std::invalid_argument);
  EXPECT_THROW(spheroid(grid, 0), std::invalid_argument);
  EXPECT_THROW(ellipsoid(grid, {1, -1, 1}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.effective_radius = 0}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.rotation = 2 * Eigen::Matrix3d::Identity()}), std::invalid_argument);
  EXPECT_THROW(sphere(grid, {.rotation = -Eigen::Matrix3d::Identity()}), std::invalid_argument);
  try {
    prolate(grid, 1.25);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "reduced_volume = 1.25: must be in (0, 1]");
  }
}

}  // namespace
}  // namespace vesiflow::vesicle
