// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mirror_symmetry.h"

#include <gtest/gtest.h>

#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"

namespace vesiflow::coupling::mirror_symmetry_test {
namespace {

using vesicle::VectorField;

// A box whose lower ends along x and y are planes of symmetry, at 0.5 and -1.
SimulationParameters half_box() {
  SimulationParameters parameters;
  parameters.domain.lower = {0.5, -1.0, -3.0};
  parameters.domain.mirror = {true, true, false};
  return parameters;
}

VectorField markers_at(const std::array<double, 3>& centre) {
  const vesicle::SphereGrid grid(10);
  vesicle::Placement placement;
  for (int axis = 0; axis < 3; ++axis) placement.centre(axis) = centre[static_cast<std::size_t>(axis)];
  return vesicle::sphere(grid, placement);
}

TEST(MirrorSymmetry, ImagesAreMutualAndWhereTheMirrorPutsThem) {
  const VectorField markers = markers_at({0.5, -1.0, 0.0});
  const auto images = mirror_images(markers, 0, 0.5, 1e-12);
  ASSERT_TRUE(images);
  for (Eigen::Index m = 0; m < markers.rows(); ++m) {
    const Eigen::Index image = (*images)[static_cast<std::size_t>(m)];
    EXPECT_EQ((*images)[static_cast<std::size_t>(image)], m);
    EXPECT_NEAR(markers(image, 0) + markers(m, 0), 1.0, 1e-12);
    EXPECT_NEAR(markers(image, 1), markers(m, 1), 1e-12);
    EXPECT_NEAR(markers(image, 2), markers(m, 2), 1e-12);
  }
  EXPECT_FALSE(is_symmetric(markers, 0, 0.5 + 1e-9, 1e-12));
  VectorField moved = markers;
  moved(3, 2) += 1e-6;
  EXPECT_FALSE(is_symmetric(moved, 0, 0.5, 1e-9));
  EXPECT_TRUE(is_symmetric(moved, 0, 0.5, 1e-5));
}

// apply() is the projection onto what is symmetric about both planes: twice is once, markers stay symmetric, what is symmetric
// does not change, and what is taken away is orthogonal to what is left.
TEST(MirrorSymmetry, ApplyIsTheOrthogonalProjectionOntoSymmetricDisplacements) {
  const VectorField markers = markers_at({0.5, -1.0, 0.0});
  const MirrorSymmetry symmetry(half_box(), markers);
  std::srand(1);
  const Eigen::ArrayXXd any = Eigen::ArrayXXd::Random(markers.rows(), 5);  // x, y, z and two scalars
  Eigen::ArrayXXd once = any;
  symmetry.apply(once);
  for (int axis = 0; axis < 2; ++axis)
    EXPECT_TRUE(is_symmetric(markers + 0.1 * once.leftCols(3), axis, half_box().domain.lower[axis], 1e-12));
  const auto images = mirror_images(markers, 1, -1.0, 1e-12);
  ASSERT_TRUE(images);
  for (Eigen::Index m = 0; m < markers.rows(); ++m) {
    const Eigen::Index image = (*images)[static_cast<std::size_t>(m)];
    EXPECT_EQ(once(m, 1), -once(image, 1));
    for (const int even : {0, 2, 3, 4}) EXPECT_EQ(once(m, even), once(image, even));
  }
  Eigen::ArrayXXd twice = once;
  symmetry.apply(twice);
  EXPECT_TRUE((twice == once).all());
  EXPECT_NEAR(((any - once) * once).sum(), 0.0, 1e-12 * any.square().sum());
  EXPECT_GT((any - once).square().sum(), 0.1 * any.square().sum());
}

TEST(MirrorSymmetry, LeavesAMembraneOnOneSideAlone) {
  const VectorField markers = markers_at({3.0, 2.0, 0.0});
  const Eigen::ArrayXXd any = Eigen::ArrayXXd::Random(markers.rows(), 3);
  Eigen::ArrayXXd same = any;
  MirrorSymmetry(half_box(), markers).apply(same);
  EXPECT_TRUE((same == any).all());
}

TEST(MirrorSymmetry, RefusesAMembraneAcrossAPlaneThatIsNotSymmetric) {
  EXPECT_THROW(MirrorSymmetry(half_box(), markers_at({0.7, 2.0, 0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::mirror_symmetry_test
