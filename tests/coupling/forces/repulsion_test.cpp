// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/repulsion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <random>

#include "support/allocation_counter.h"
#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::repulsion_test {
namespace {

using vesicle::ScalarField;
using vesicle::Vector3;
using vesicle::VectorField;

const fluid::Grid walls({-10, -10, -10}, {10, 10, 10}, {8, 8, 8});

struct Markers {
  Markers(VectorField x, ScalarField a)
      : positions(std::move(x)), area(std::move(a)), force(VectorField::Zero(positions.rows(), 3)) {}
  RepelledMembrane repelled() { return {&positions, &area, &force}; }
  Vector3 total() const {
    return {(force.col(0) * area).sum(), (force.col(1) * area).sum(), (force.col(2) * area).sum()};
  }
  Vector3 torque() const {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index m = 0; m < area.size(); ++m)
      sum += positions.row(m).matrix().transpose().cross(Vector3(force.row(m).matrix().transpose())) * area(m);
    return sum;
  }

  VectorField positions;
  ScalarField area;
  VectorField force;
};

Markers cloud(int markers, const Vector3& centre, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-size, size), area(0.5, 1.5);
  VectorField x(markers, 3);
  ScalarField a(markers);
  for (int m = 0; m < markers; ++m) {
    for (int axis = 0; axis < 3; ++axis) x(m, axis) = centre(axis) + uniform(generator);
    a(m) = area(generator);
  }
  return {x, a};
}

std::vector<RepelledMembrane> repelled(std::vector<Markers>& all) {
  std::vector<RepelledMembrane> list;
  for (Markers& markers : all) list.push_back(markers.repelled());
  return list;
}

// A square of n x n markers, s apart, at height z.
Markers plane(int n, double s, double z) {
  VectorField x(n * n, 3);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) x.row(j * n + i) << s * (i - n / 2), s * (j - n / 2), z;
  return {x, ScalarField::Constant(n * n, s * s)};
}

// The equation that the pair force is made for, by sums over squares larger than the range. The sum over a lattice of spacing s
// is off by exp(-2 pi d/s), and by O(s^2) for the kink at the edge of the range.
TEST(Repulsion, ParallelPlanesPressWithTheStatedPressure) {
  const double range = 0.5, strength = 7.0, s = 0.02;
  for (const double d : {0.1, 0.2, 0.35, 0.45, 0.51}) {
    std::vector<Markers> planes{plane(61, s, 0.0), plane(61, s, d)};
    Repulsion(walls, {range, strength}, 61 * 61).add_forces(repelled(planes));
    const Eigen::Index middle = 30 * 61 + 30;
    const double expected = d < range ? strength * (1 - d / range) * (1 - d / range) : 0.0;
    EXPECT_NEAR(planes[1].force(middle, 2), expected, 2e-3 * strength) << d;
    EXPECT_NEAR(planes[0].force(middle, 2), -expected, 2e-3 * strength) << d;
    EXPECT_NEAR(planes[1].force(middle, 0), 0.0, 1e-12);
  }
}

TEST(Repulsion, AWallPressesWithTheStatedPressureAlongItsNormal) {
  std::vector<Markers> markers{Markers(VectorField(3, 3), ScalarField::Constant(3, 0.1))};
  markers[0].positions << -9.9, 0, 0, 0, 9.8, 0, 0, 0, -9.4;
  Repulsion(walls, {0.5, 3.0}, 3).add_forces(repelled(markers));
  VectorField expected = VectorField::Zero(3, 3);
  expected(0, 0) = 3.0 * 0.8 * 0.8;
  expected(1, 1) = -3.0 * 0.6 * 0.6;
  EXPECT_LT((markers[0].force - expected).abs().maxCoeff(), 1e-12);
  markers[0].force.setZero();
  Repulsion(walls, {0.5, 3.0, false}, 3).add_forces(repelled(markers));
  EXPECT_EQ(markers[0].force.abs().maxCoeff(), 0.0);
}

// Pairs, walls and images: walls along z, the clouds near one of them and near the two ends of the periodic axes.
class RandomClouds : public testing::Test {
 protected:
  const fluid::Grid grid_{{0, 0, 0}, {2, 3, 4}, {8, 8, 8}, {true, true, false}};
  std::vector<Markers> clouds_{cloud(40, {0.2, 0.3, 0.4}, 0.4, 1), cloud(30, {1.9, 2.9, 0.4}, 0.4, 2),
                               cloud(20, {0.4, 3.2 + 6.0, 0.9}, 0.4, 3)};
  Repulsion repulsion_{grid_, {0.6, 5.0}, 40};
};

TEST_F(RandomClouds, ForceIsMinusTheGradientOfTheEnergy) {
  const std::vector<RepelledMembrane> list = repelled(clouds_);
  repulsion_.add_forces(list);
  for (const auto& [cloud, marker] : {std::pair{0, 3}, {0, 17}, {1, 5}, {1, 29}, {2, 0}, {2, 11}}) {
    for (int axis = 0; axis < 3; ++axis) {
      Markers& c = clouds_[static_cast<std::size_t>(cloud)];
      double& x = c.positions(marker, axis);
      const double here = x, step = 1e-6;
      x = here + step;
      const double above = repulsion_.energy(list);
      x = here - step;
      const double below = repulsion_.energy(list);
      x = here;
      const double force = c.force(marker, axis) * c.area(marker);
      EXPECT_NEAR(force, -(above - below) / (2 * step), 1e-5 * (1.0 + std::abs(force))) << cloud << ' ' << marker;
    }
  }
}

TEST_F(RandomClouds, IsTheSumOverAllPairsOfImages) {
  for (Markers& c : clouds_) c.force.setZero();
  repulsion_.add_forces(repelled(clouds_));
  const double range = 0.6, factor = 5.0 / (2 * std::numbers::pi);
  for (std::size_t a = 0; a < clouds_.size(); ++a) {
    VectorField expected = VectorField::Zero(clouds_[a].area.size(), 3);
    for (std::size_t b = 0; b < clouds_.size(); ++b)
      for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j) {
          if (a == b && i == 0 && j == 0) continue;
          for (Eigen::Index m = 0; m < clouds_[a].area.size(); ++m)
            for (Eigen::Index n = 0; n < clouds_[b].area.size(); ++n) {
              const Vector3 r = (clouds_[a].positions.row(m) - clouds_[b].positions.row(n)).matrix().transpose() -
                                Vector3(2.0 * i, 3.0 * j, 0.0);
              const double d = r.norm();
              if (d >= range) continue;
              const double push = factor * (1 / (d * d) - 1 / (range * range)) / d * clouds_[b].area(n);
              expected.row(m) += (push * r).array().transpose();
            }
        }
    for (Eigen::Index m = 0; m < clouds_[a].area.size(); ++m) {
      const double depth = 1 - clouds_[a].positions(m, 2) / range;
      if (depth > 0) expected(m, 2) += 5.0 * depth * depth;
    }
    EXPECT_LT((clouds_[a].force - expected).abs().maxCoeff(), 1e-12 * expected.abs().maxCoeff());
  }
}

TEST(Repulsion, BetweenMembranesConservesMomentumAndAngularMomentum) {
  std::vector<Markers> clouds{cloud(200, {0, 0, 0}, 1.0, 4), cloud(300, {1, 0.5, 0}, 1.0, 5)};
  Repulsion(walls, {0.5, 2.0}, 300).add_forces(repelled(clouds));
  const double scale = (clouds[0].force.abs().colwise() * clouds[0].area).sum();
  EXPECT_GT(scale, 1.0);
  EXPECT_LT((clouds[0].total() + clouds[1].total()).norm(), 1e-13 * scale);
  EXPECT_LT((clouds[0].torque() + clouds[1].torque()).norm(), 1e-13 * scale);
}

TEST_F(RandomClouds, DoesNotDependOnTheOrderOfTheMembranes) {
  repulsion_.add_forces(repelled(clouds_));
  std::vector<Markers> turned{clouds_[2], clouds_[0], clouds_[1]};
  for (Markers& c : turned) c.force.setZero();
  repulsion_.add_forces(repelled(turned));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((turned[(i + 1) % 3].force - clouds_[i].force).abs().maxCoeff(),
              1e-12 * clouds_[i].force.abs().maxCoeff());
}

TEST_F(RandomClouds, AllocatesNothingOnceItHasRun) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  const std::vector<RepelledMembrane> list = repelled(clouds_);
  repulsion_.add_forces(list);
  const long before = test::allocation_count();
  repulsion_.add_forces(list);
  EXPECT_EQ(test::allocation_count() - before, 0);
}

// Derjaguin: the force between two spheres of radius a is pi a times the integral of the pressure between planes from the gap on,
// to O(R/a).
TEST(Repulsion, OfSpheresIsDerjaguins) {
  const double range = 0.2, strength = 4.0, gap = 0.1;
  const vesicle::SphereGrid grid(96);
  vesicle::Surface surface(grid);
  vesicle::Placement placement;
  surface.update(vesicle::sphere(grid, placement));
  std::vector<Markers> spheres{{surface.positions(), surface.area_weight()},
                               {surface.positions(), surface.area_weight()}};
  spheres[1].positions.col(0) += 2.0 + gap;
  Repulsion(walls, {range, strength}, 2 * 96 * 96).add_forces(repelled(spheres));
  const double depth = 1 - gap / range;
  const double derjaguin = std::numbers::pi * strength * range / 3 * depth * depth * depth;
  EXPECT_NEAR(spheres[1].total().x() / derjaguin, 1.0, 0.1);
  EXPECT_LT(std::abs(spheres[1].total().y()), 1e-10);
}

TEST(Repulsion, RefusesParametersOutOfRangeByName) {
  EXPECT_THROW(Repulsion(walls, {0.0, 1.0}, 8), std::invalid_argument);
  EXPECT_THROW(Repulsion(walls, {0.1, -1.0}, 8), std::invalid_argument);
  EXPECT_THROW(Repulsion(walls, {0.1, std::nan("")}, 8), std::invalid_argument);
}

TEST(Repulsion, RefusesArraysOfDifferentSizes) {
  VectorField positions = VectorField::Random(5, 3), force = VectorField::Zero(5, 3), few = VectorField::Zero(4, 3);
  const ScalarField areas = ScalarField::Ones(5), few_areas = ScalarField::Ones(4);
  Repulsion repulsion(walls, {0.2, 1.0}, 5);
  const auto add = [&](const RepelledMembrane& membrane) { repulsion.add_forces({&membrane, 1}); };
  EXPECT_NO_THROW(add({&positions, &areas, &force}));
  EXPECT_THROW(add({&positions, &few_areas, &force}), std::invalid_argument);
  EXPECT_THROW(add({&positions, &areas, &few}), std::invalid_argument);
  EXPECT_THROW(add({&positions, &areas, nullptr}), std::invalid_argument);
  const RepelledMembrane without_force{&positions, &areas, nullptr};
  EXPECT_NO_THROW(repulsion.energy({&without_force, 1}));
}

}  // namespace
}  // namespace vesiflow::coupling::repulsion_test
