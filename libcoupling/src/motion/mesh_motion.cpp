// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/mesh_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/constants.h"
#include "motion/flat_coefficients.h"
#include "vesicle/rigid_motion.h"

namespace vesiflow::coupling {
namespace {

using vesicle::Surface;
using vesicle::Vector3;
using vesicle::VectorField;

double greatest_difference(const VectorField& velocity, const Vector3& from) {
  double largest_square = 0.0;
  for (Eigen::Index m = 0; m < velocity.rows(); ++m) {
    double square = 0.0;
    for (int i = 0; i < 3; ++i) square += (velocity(m, i) - from(i)) * (velocity(m, i) - from(i));
    largest_square = std::max(largest_square, square);
  }
  return std::sqrt(largest_square);
}

}  // namespace

MeshMotion::MeshMotion(const vesicle::SphericalHarmonics& harmonics, double radius)
    : harmonics_(harmonics), radius_(radius), coefficients_(harmonics.degrees(), 3) {
  const Eigen::Index markers = harmonics.grid().size();
  for (VectorField* field : {&velocities_.membrane, &velocities_.mesh, &direction_})
    *field = VectorField::Zero(markers, 3);
}

const MeshMotion::Velocities& MeshMotion::find(double dt, const Surface& surface, const VectorField& fluid_velocity) {
  VectorField& u = velocities_.membrane;
  harmonics_.analysis(fluid_velocity, coefficients_);
  harmonics_.synthesis(coefficients_, u);
  normal_velocity_ = (u * surface.normal()).rowwise().sum();
  const vesicle::RigidMotion rigid = vesicle::rigid_motion_of_shape(surface, normal_velocity_);
  const Vector3& v = rigid.velocity;
  velocities_.largest_speed = greatest_difference(u, v);
  const double turning_speed = radius_ * rigid.angular_velocity.norm();
  const double fastest = constants::fastest_turning * velocities_.largest_speed;
  const Vector3 omega =
      turning_speed > fastest ? Vector3(fastest / turning_speed * rigid.angular_velocity) : rigid.angular_velocity;
  for (Eigen::Index m = 0; m < u.rows(); ++m) {
    std::array<double, 3> r, along;
    for (int i = 0; i < 3; ++i) r[i] = surface.positions()(m, i) - rigid.centre(i);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      along[i] = v(i) + omega(j) * r[k] - omega(k) * r[j];
    }
    double excess = normal_velocity_(m);
    for (int i = 0; i < 3; ++i) excess -= along[i] * surface.normal()(m, i);
    for (int i = 0; i < 3; ++i) velocities_.mesh(m, i) = along[i] + excess * surface.normal()(m, i);
  }
  relax(std::min(constants::mesh_relaxation * velocities_.largest_speed / radius_,
                 constants::largest_mesh_relaxation / dt),
        surface);
  return velocities_;
}

// Adds lambda P d. The direction is that of steepest descent of the mesh energy in the norm of its own second
// derivative, so that all degrees relax at about the same rate. Degrees 0 and 1 have no weight of their own in it and
// take that of degree 2, the lowest that they meet there.
void MeshMotion::relax(double rate, const Surface& surface) {
  descent_.direction(harmonics_, surface, direction_);
  velocities_.mesh += rate * direction_;
}

}  // namespace vesiflow::coupling
