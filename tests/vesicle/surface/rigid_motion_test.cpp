// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/rigid_motion.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::rigid_motion_test {
namespace {

using std::numbers::pi;

constexpr int latitudes = 20;
const Vector3 drift(0.3, -0.7, 0.4), spin(0.5, 1.1, -0.6), middle(0.4, -1.2, 2.3);

Placement turned() {
  return {.effective_radius = 1.3,
          .rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix(),
          .centre = middle};
}

ScalarField normal_part(const Surface& surface, const VectorField& velocity) {
  return (velocity * surface.normal()).rowwise().sum();
}

/// V + Omega x (x - c) of a body about c.
VectorField rigid(const Surface& surface, const Vector3& v, const Vector3& omega) {
  VectorField r = surface.positions();
  for (int axis = 0; axis < 3; ++axis) r.col(axis) -= middle[axis];
  VectorField velocity = testing::cross(omega, r);
  for (int axis = 0; axis < 3; ++axis) velocity.col(axis) += v[axis];
  return velocity;
}

/// The damping of eps = 1e-6 takes eps/(eps + share) off each part, the share being that of its velocity which is normal: a third
/// for V, and above 0.02 for a spin of this ellipsoid.
TEST(RigidMotion, IsThatOfARigidEllipsoid) {
  Surface surface(latitudes);
  surface.update(ellipsoid(surface.grid(), {1, 1.5, 2.2}, turned()));
  const RigidMotion motion = rigid_motion_of_shape(surface, normal_part(surface, rigid(surface, drift, spin)));
  EXPECT_LT((motion.centre - middle).norm(), 1e-12);
  EXPECT_LT((motion.velocity - drift).norm(), 1e-5 * drift.norm());
  EXPECT_LT((motion.angular_velocity - spin).norm(), 5e-5 * spin.norm());
  EXPECT_GT((motion.angular_velocity - spin).norm(), 1e-7 * spin.norm());  // it is there
}

TEST(RigidMotion, DoesNotTurnABodyOfRevolutionAboutItsAxis) {
  for (const double aspect_ratio : {0.5, 2.0}) {
    Surface surface(latitudes);
    surface.update(spheroid(surface.grid(), aspect_ratio, turned()));
    const Vector3 axis = turned().rotation.col(2);
    const RigidMotion motion = rigid_motion_of_shape(surface, normal_part(surface, rigid(surface, drift, spin)));
    EXPECT_LT((motion.velocity - drift).norm(), 1e-5 * drift.norm());
    EXPECT_NEAR(motion.angular_velocity.dot(axis), 0, 1e-6);  // round-off over eps
    const Vector3 across = spin - spin.dot(axis) * axis;
    EXPECT_LT((motion.angular_velocity - motion.angular_velocity.dot(axis) * axis - across).norm(), 5e-5);
  }
}

TEST(RigidMotion, OfASphereIsOnlyAVelocity) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid(), turned()));
  const RigidMotion motion = rigid_motion_of_shape(surface, normal_part(surface, rigid(surface, drift, spin)));
  // int (e.n)^2 dA is A/3.
  EXPECT_LT((motion.velocity * (1 + 3e-6) - drift).norm(), 1e-10);
  EXPECT_LT(motion.angular_velocity.norm(), 1e-6);
}

/// As tank-treading does; the ellipsoid turns in its own coordinates, u = (S M S^{-1}) x with M antisymmetric.
TEST(RigidMotion, IsZeroWhereNothingMovesAlongTheNormal) {
  Surface surface(latitudes);
  const Vector3 axes(1, 1.5, 2.2);
  surface.update(ellipsoid(surface.grid(), axes));
  const double scale = std::cbrt(1 / axes.prod());
  VectorField flow = surface.positions();
  for (int axis = 0; axis < 3; ++axis) flow.col(axis) /= axes[axis] * scale;
  flow = testing::cross(spin, flow);
  for (int axis = 0; axis < 3; ++axis) flow.col(axis) *= axes[axis] * scale;
  ASSERT_GT(flow.abs().maxCoeff(), 0.5);
  const RigidMotion motion = rigid_motion_of_shape(surface, normal_part(surface, flow));
  EXPECT_LT(motion.velocity.norm(), 1e-12);
  EXPECT_LT(motion.angular_velocity.norm(), 1e-12);
}

/// What is left is not explained by any other rigid motion: the defining minimum, against differences of the functional.
TEST(RigidMotion, MinimisesWhatIsLeftOfTheNormalVelocity) {
  Surface surface(latitudes);
  surface.update(ellipsoid(surface.grid(), {1, 1.5, 2.2}, turned()));
  const ScalarField velocity = testing::smooth_scalar(surface.grid(), 6, 71);
  const RigidMotion motion = rigid_motion_of_shape(surface, velocity);
  const auto left = [&](const Vector3& v, const Vector3& omega) {
    double radius_square = 0;
    for (int axis = 0; axis < 3; ++axis)
      radius_square += surface.integral(ScalarField((surface.positions().col(axis) - middle[axis]).square()));
    return surface.integral(ScalarField((velocity - normal_part(surface, rigid(surface, v, omega))).square())) +
           1e-6 * (v.squaredNorm() * surface.area() + omega.squaredNorm() * radius_square);
  };
  const double least = left(motion.velocity, motion.angular_velocity);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = 1e-3 * Vector3::Unit(axis);
    const auto slope = [&](const Vector3& dv, const Vector3& domega) {
      return left(motion.velocity + dv, motion.angular_velocity + domega) -
             left(motion.velocity - dv, motion.angular_velocity - domega);
    };
    EXPECT_LT(std::abs(slope(step, Vector3::Zero())), 1e-12 * least) << axis;
    EXPECT_LT(std::abs(slope(Vector3::Zero(), step)), 1e-12 * least) << axis;
    EXPECT_GT(left(motion.velocity + step, motion.angular_velocity), least);
    EXPECT_GT(left(motion.velocity, motion.angular_velocity + step), least);
  }
}

TEST(RigidMotion, RefusesBadArguments) {
  Surface surface(latitudes);
  surface.update(sphere(surface.grid()));
  const ScalarField good = ScalarField::Zero(surface.grid().size());
  EXPECT_THROW(rigid_motion_of_shape(surface, ScalarField::Zero(3)), std::invalid_argument);
  testing::expect_refused_if_not_finite(good, [&](const ScalarField& v) { rigid_motion_of_shape(surface, v); });
}

}  // namespace
}  // namespace vesiflow::vesicle::rigid_motion_test
