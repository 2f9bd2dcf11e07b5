// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/interface_velocity.h"

#include <Eigen/Dense>
#include <cmath>

#include "viscosity/rigid_response.h"

namespace vesiflow::coupling {

InterfaceVelocity::InterfaceVelocity(double ratio, Eigen::Index markers)
    : ratio_(ratio),
      more_translation_(0.5 * (ratio - 1.0)),
      more_rotation_(more_translation_),
      velocity_(vesicle::VectorField::Zero(markers, 3)),
      jump_(vesicle::VectorField::Zero(markers, 3)),
      change_(vesicle::VectorField::Zero(markers, 3)) {}

void InterfaceVelocity::set_inertia(double a_r2) {
  const RigidResponse mean = rigid_response(a_r2);
  // What is left of a change is the eigenvalue 2 (1 - ratio)/(1 + ratio) mean.
  const auto more = [this](double of_jump) {
    const double eigenvalue = 2.0 * (1.0 - ratio_) / (1.0 + ratio_) * of_jump;
    return eigenvalue / (1.0 - eigenvalue);
  };
  more_translation_ = more(mean.translation);
  more_rotation_ = more(mean.rotation);
}

const vesicle::VectorField& InterfaceVelocity::jump() {
  jump_ = (1.0 - ratio_) * velocity_;
  return jump_;
}

vesicle::Vector3 InterfaceVelocity::displaced(const vesicle::Surface& surface) {
  const vesicle::ScalarField flux = (jump() * surface.normal()).rowwise().sum() * surface.area_weight();
  const vesicle::Vector3 centre = surface.integral(surface.positions()) / surface.area();
  vesicle::Vector3 moment;
  for (int axis = 0; axis < 3; ++axis) moment[axis] = ((surface.positions().col(axis) - centre[axis]) * flux).sum();
  return moment;
}

double InterfaceVelocity::improve(const vesicle::Surface& surface, const vesicle::VectorField& mean) {
  using Vector = Eigen::Vector3d;
  change_ = (2.0 / (1.0 + ratio_)) * mean;
  change_ -= surface.normal() * (surface.flux(change_) / surface.area());
  change_ -= velocity_;

  // Its rigid part: least squares over the membrane, about the centroid of the area.
  const vesicle::VectorField& x = surface.positions();
  const vesicle::ScalarField& weight = surface.area_weight();
  const Vector centre = surface.integral(x) / surface.area();
  const Vector velocity = surface.integral(change_) / surface.area();
  Vector momentum = Vector::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (Eigen::Index m = 0; m < x.rows(); ++m) {
    const Vector r = Vector(x.row(m).transpose()) - centre;
    momentum += weight[m] * r.cross(Vector(change_.row(m).transpose()));
    inertia += weight[m] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Vector turning = inertia.ldlt().solve(momentum);
  for (Eigen::Index m = 0; m < x.rows(); ++m) {
    const Vector turned = turning.cross(Vector(x.row(m).transpose()) - centre);
    change_.row(m) += (more_translation_ * velocity + more_rotation_ * turned).transpose().array();
  }

  velocity_ += change_;
  const auto size = [&](const vesicle::VectorField& field) {
    return std::sqrt((field.square().rowwise().sum() * weight).sum());
  };
  const double speed = size(velocity_);
  return speed > 0.0 ? size(change_) / speed : 0.0;
}

}  // namespace vesiflow::coupling
