// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mesh_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/constants.h"
#include "motion/membrane_condition.h"
#include "motion/slip.h"
#include "motion/strain_motion.h"
#include "vesicle/redistribution.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling::mesh_motion_test {
namespace {

using vesicle::Vector3;
using vesicle::VectorField;

constexpr int latitudes = 24, degrees = 16;
const Vector3 axes(1.0, 1.3, 1.8);

VectorField rigid(const VectorField& x, const Vector3& velocity, const Vector3& omega) {
  VectorField result(x.rows(), 3);
  for (Eigen::Index m = 0; m < x.rows(); ++m)
    result.row(m) = (velocity + omega.cross(Vector3(x.row(m).matrix().transpose()))).transpose().array();
  return result;
}

double largest(const VectorField& field) {
  return field.abs().maxCoeff();
}

class MeshMotionTest : public testing::Test {
 protected:
  MeshMotionTest() : grid(latitudes), harmonics(degrees, grid, 4), surface(grid) {}

  /// An ellipsoid; with a shear of the mesh along it of that size, which its shape knows nothing of.
  void place(double shear = 0.0) {
    VectorField x = vesicle::sphere(grid);
    for (Eigen::Index m = 0; m < x.rows(); ++m) {
      Vector3 y = x.row(m).matrix().transpose();
      y = Eigen::AngleAxisd(shear * y.z() * y.z(), Vector3::UnitZ()) * y;
      x.row(m) = (y.array() * axes.array()).transpose();
    }
    surface.update(x, vesicle::GeometryDetail::first_form);
  }
  /// How far markers are from the ellipsoid.
  static double distance(const VectorField& x) {
    double greatest = 0.0;
    for (Eigen::Index m = 0; m < x.rows(); ++m)
      greatest = std::max(greatest, std::abs((x.row(m).transpose() / axes.array()).matrix().norm() - 1.0));
    return greatest;
  }
  /// A velocity along the membrane, but for what is cut off its degrees.
  VectorField tangential() const {
    VectorField u = rigid(surface.positions(), Vector3::Zero(), {0.3, 0.4, 1.0});
    for (Eigen::Index m = 0; m < u.rows(); ++m) {
      const double normal = (u.row(m) * surface.normal().row(m)).sum();
      u.row(m) -= normal * surface.normal().row(m);
    }
    return u;
  }

  vesicle::SphereGrid grid;
  vesicle::SphericalHarmonics harmonics;
  vesicle::Surface surface;
};

TEST_F(MeshMotionTest, FollowsABodyAndLeavesItsMaterialNoSlip) {
  place();
  const double radius = std::sqrt(surface.area() / (4.0 * std::numbers::pi));
  MeshMotion motion(harmonics, radius);
  const VectorField u = rigid(surface.positions(), {0.2, -0.1, 0.4}, {0.3, 0.5, -0.2});
  const auto& moving = motion.find(0.01, surface, u);
  EXPECT_LT(largest(moving.membrane - u), 1e-12);
  // The rigid motion is found but for 1e-6 over the share of it that moves the shape (vesicle/rigid_motion.h).
  EXPECT_LT(largest(moving.mesh - u), 1e-3);
  EXPECT_GT(largest(u), 0.5);
}

TEST_F(MeshMotionTest, StandsStillWhereASphereTurns) {
  surface.update(vesicle::sphere(grid));
  MeshMotion motion(harmonics, 1.0);
  const auto& moving = motion.find(0.01, surface, rigid(surface.positions(), Vector3::Zero(), {0.0, 0.0, 0.5}));
  EXPECT_LT(largest(moving.mesh), 1e-10);
  EXPECT_NEAR(moving.largest_speed, 0.5, 2e-3);  // no marker is on the equator
}

// The normal velocity is the membrane's, whatever the mesh does along it.
TEST_F(MeshMotionTest, MovesTheShapeAsTheMembraneDoes) {
  place(0.6);
  MeshMotion motion(harmonics, 1.0);
  VectorField u = surface.positions();
  for (Eigen::Index m = 0; m < u.rows(); ++m) u.row(m) << u(m, 2), 0.3 * u(m, 0), -0.5 * u(m, 1);
  const auto& moving = motion.find(0.01, surface, u);
  EXPECT_LT((((moving.mesh - moving.membrane) * surface.normal()).rowwise().sum()).abs().maxCoeff(), 1e-12);
}

// Along a shape at rest markers leave it by the square of a step only.
TEST_F(MeshMotionTest, KeepsTheShapeToSecondOrder) {
  place(0.6);
  const VectorField x = surface.positions();
  EXPECT_LT(distance(x), 1e-14);
  MeshMotion motion(harmonics, 1.0);
  const auto& moving = motion.find(1e-6, surface, tangential());
  // What the degrees that are kept have of the velocity is not quite along the membrane.
  const vesicle::ScalarField leak = (moving.mesh * surface.normal()).rowwise().sum();
  VectorField along = moving.mesh;
  for (Eigen::Index m = 0; m < along.rows(); ++m) along.row(m) -= leak(m) * surface.normal().row(m);
  EXPECT_LT(leak.abs().maxCoeff(), 0.02 * largest(along));
  const double whole = distance(x + 0.02 * along), half = distance(x + 0.01 * along);
  EXPECT_GT(whole, 1e-6);
  EXPECT_NEAR(whole / half, 4.0, 0.3);
}

// Along the shape it goes down the mesh energy, which is zero for an ellipsoid's own mesh.
TEST_F(MeshMotionTest, GoesDownTheMeshEnergy) {
  const auto energy = [&](const VectorField& x) {
    vesicle::Coefficients c;
    harmonics.analysis(x, c);
    double sum = 0.0;
    for (int n = 0; n < degrees; ++n) sum += vesicle::mesh_energy_weight(n) * c.energy(n, n + 1);
    return sum;
  };
  place();
  EXPECT_LT(energy(surface.positions()), 1e-20);
  place(0.6);
  const VectorField x = surface.positions();
  MeshMotion motion(harmonics, 1.0);
  VectorField along = motion.find(1e-6, surface, tangential()).mesh;
  for (Eigen::Index m = 0; m < along.rows(); ++m) {
    const double normal = (along.row(m) * surface.normal().row(m)).sum();
    along.row(m) -= normal * surface.normal().row(m);
  }
  for (const double time : {0.01, 0.1}) EXPECT_LT(energy(x + time * along), (1.0 - 0.5 * time) * energy(x)) << time;
}

TEST_F(MeshMotionTest, CompressionIsThatOfTheShortAxis) {
  place();
  // Lengths along x are 1 of a sphere of radius R.
  for (const double radius : {1.0, 1.4}) EXPECT_NEAR(greatest_compression(surface, radius), radius, 0.01 * radius);
  EXPECT_EQ(greatest_compression(surface, 0.5), 1.0);
}

// The material of a sphere that grows gains area at 2 U/R, and slips by nothing.
TEST_F(MeshMotionTest, StrainGrowsWithTheAreaAndGoesWithTheSlip) {
  surface.update(vesicle::sphere(grid));
  StrainMotion motion(grid.size());
  const vesicle::ScalarField strain = surface.positions().col(0);
  const VectorField growth = 0.3 * surface.positions(),
                    turning = rigid(surface.positions(), Vector3::Zero(), {0.0, 0.0, 0.5});
  EXPECT_LT((motion.find_rate(surface, growth, growth, strain) - 0.6).abs().maxCoeff(), 1e-10);
  // Turning below a mesh at rest: ds/dt = -w.grad x = 0.5 y.
  const VectorField none = VectorField::Zero(grid.size(), 3);
  EXPECT_LT((motion.find_rate(surface, turning, none, strain) - 0.5 * surface.positions().col(1)).abs().maxCoeff(),
            1e-10);
  Slip slip;
  slip.find(surface, turning, none);
  EXPECT_LT(slip.theta.abs().maxCoeff(), 1e-10);
  EXPECT_LT((slip.phi - 0.5).abs().maxCoeff(), 1e-10);
  EXPECT_EQ(motion.entries(), 2);
}

// int exp(-s) dA is the area of the unstrained membrane.
TEST_F(MeshMotionTest, MissingStrainRateKeepsTheUnstrainedArea) {
  place();
  StrainMotion motion(grid.size());
  const vesicle::ScalarField strain = 0.1 * surface.positions().col(2);
  VectorField u = surface.positions(), w = u;
  u.col(1) *= 0.4;
  w.col(0) *= -0.7;
  vesicle::ScalarField rate = motion.find_rate(surface, u, w, strain);
  rate += motion.missing_rate(surface, w, strain);
  const auto unstrained = [&](double dt) {
    vesicle::Surface moved(grid);
    moved.update(surface.positions() + dt * w);
    return (moved.area_weight() * (-(strain + dt * rate)).exp()).sum();
  };
  EXPECT_NEAR((unstrained(1e-5) - unstrained(-1e-5)) / 2e-5, 0.0, 1e-6);
}

}  // namespace
}  // namespace vesiflow::coupling::mesh_motion_test
