// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/buoyancy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"

namespace vesiflow::coupling::buoyancy_test {
namespace {

using vesicle::Vector3;
using vesicle::VectorField;

vesicle::Surface prolate_at(const Vector3& centre) {
  const vesicle::SphereGrid grid(32);
  vesicle::Placement placement;
  placement.centre = centre;
  vesicle::Surface surface(grid);
  surface.update(vesicle::prolate(grid, 0.9, placement));
  return surface;
}

// By the divergence theorem; the torque about the centre vanishes too, as the pressure field's does.
TEST(Buoyancy, TotalIsTheWeightTimesTheVolume) {
  const Vector3 weight(0.3, -0.2, -1.7);
  const vesicle::Surface surface = prolate_at({1.0, -2.0, 3.0});
  VectorField force = VectorField::Zero(surface.positions().rows(), 3);
  add_buoyancy(surface, weight, force);
  EXPECT_LT((surface.integral(force) - surface.volume() * weight).norm(), 1e-10);
  EXPECT_NEAR(surface.volume(), 4 * std::numbers::pi / 3, 1e-10);
  VectorField torque(force.rows(), 3);
  for (Eigen::Index m = 0; m < force.rows(); ++m) {
    const Vector3 arm = surface.positions().row(m).matrix().transpose() - Vector3(1.0, -2.0, 3.0);
    torque.row(m) = arm.cross(Vector3(force.row(m).matrix().transpose())).array().transpose();
  }
  EXPECT_LT(surface.integral(torque).norm(), 1e-10);
}

// On a sphere of radius 1: the pressure is weight . n.
TEST(Buoyancy, OnASphereIsTheHydrostaticPressureAlongTheNormal) {
  const vesicle::SphereGrid grid(16);
  vesicle::Surface surface(grid);
  surface.update(vesicle::sphere(grid, {}));
  VectorField force = VectorField::Ones(surface.positions().rows(), 3);
  add_buoyancy(surface, {0.0, 0.0, -2.0}, force);
  for (Eigen::Index m = 0; m < force.rows(); ++m) {
    const Vector3 n = surface.positions().row(m).matrix().transpose();
    EXPECT_LT((force.row(m).matrix().transpose() - Vector3::Ones() + 2.0 * n.z() * n).norm(), 1e-12);
  }
}

// A vesicle that has gone many periods along a periodic axis is pushed as it was at home.
TEST(Buoyancy, DoesNotDependOnThePlace) {
  const Vector3 weight(1.0, 2.0, -3.0);
  const vesicle::Surface here = prolate_at({0, 0, 0}), there = prolate_at({600, -40, 0});
  VectorField a = VectorField::Zero(here.positions().rows(), 3), b = a;
  add_buoyancy(here, weight, a);
  add_buoyancy(there, weight, b);
  EXPECT_LT((a - b).abs().maxCoeff(), 1e-9);
}

TEST(Buoyancy, RefusesAForceOfAnotherSize) {
  const vesicle::Surface surface = prolate_at({0, 0, 0});
  VectorField force = VectorField::Zero(surface.positions().rows() - 1, 3);
  EXPECT_THROW(add_buoyancy(surface, {0.0, 0.0, 1.0}, force), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::buoyancy_test
