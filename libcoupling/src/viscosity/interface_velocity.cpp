// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/interface_velocity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "viscosity/rigid_response.h"

namespace vesiflow::coupling {
namespace {

double product(const vesicle::VectorField& a, const vesicle::VectorField& b, const vesicle::ScalarField& weight) {
  return ((a * b).rowwise().sum() * weight).sum();
}

}  // namespace

InterfaceVelocity::InterfaceVelocity(double ratio, Eigen::Index markers)
    : ratio_(ratio),
      more_translation_(0.5 * (ratio - 1.0)),
      more_rotation_(more_translation_),
      velocity_(vesicle::VectorField::Zero(markers, 3)),
      jump_(vesicle::VectorField::Zero(markers, 3)),
      change_(vesicle::VectorField::Zero(markers, 3)),
      previous_(vesicle::VectorField::Zero(markers, 3)),
      last_velocity_(vesicle::VectorField::Zero(markers, 3)),
      last_change_(vesicle::VectorField::Zero(markers, 3)) {
  secants_.fill({vesicle::VectorField::Zero(markers, 3), vesicle::VectorField::Zero(markers, 3)});
}

void InterfaceVelocity::set(const vesicle::VectorField& velocity, const vesicle::VectorField& previous) {
  velocity_ = velocity;
  has_previous_ = previous.rows() > 0;
  if (has_previous_) previous_ = previous;
  begin_iteration();
}

void InterfaceVelocity::begin_step(double ratio_of_steps) {
  if (!has_previous_) {
    previous_ = velocity_;
    has_previous_ = true;
    return;
  }
  change_ = velocity_ - previous_;
  previous_ = velocity_;
  velocity_ += ratio_of_steps * change_;
}

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

  const double residual = std::sqrt(product(change_, change_, weight));
  // What others do changes the map of one, where several membranes are near each other.
  if (passes_ > 0 && residual > 2.0 * last_residual_) begin_iteration();
  last_residual_ = residual;
  accelerate(weight);
  const double speed = std::sqrt(product(velocity_, velocity_, weight));
  return speed > 0.0 ? residual / speed : 0.0;
}

// U goes to where the map would change it least, were it the affine one that the last passes show, and from there by
// that least change.
void InterfaceVelocity::accelerate(const vesicle::ScalarField& weight) {
  const int known = std::min<int>(passes_, static_cast<int>(secants_.size()));
  if (passes_ > 0) {
    // The oldest gives way. Those that stay are orthogonal to each other, and the new one is made so.
    if (passes_ > known) std::rotate(secants_.begin(), secants_.begin() + 1, secants_.end());
    Secant& newest = secants_[static_cast<std::size_t>(known - 1)];
    newest.velocity = velocity_ - last_velocity_;
    newest.change = change_ - last_change_;
    const double before = product(newest.change, newest.change, weight);
    for (int k = 0; k < known - 1; ++k) {
      const Secant& older = secants_[static_cast<std::size_t>(k)];
      const double square = product(older.change, older.change, weight);
      if (!(square > 0.0)) continue;
      const double share = product(older.change, newest.change, weight) / square;
      newest.velocity -= share * older.velocity;
      newest.change -= share * older.change;
    }
    // Of which nothing is left but rounding, or what the tolerance of the fluid's solver left.
    constexpr double least_left = 1e-8;
    if (product(newest.change, newest.change, weight) < least_left * before) newest.change.setZero();
  }
  last_velocity_ = velocity_;
  last_change_ = change_;
  for (int k = 0; k < known; ++k) {
    const Secant& secant = secants_[static_cast<std::size_t>(k)];
    const double square = product(secant.change, secant.change, weight);
    if (!(square > 0.0)) continue;
    const double share = product(secant.change, change_, weight) / square;
    velocity_ -= share * secant.velocity;
    change_ -= share * secant.change;
  }
  velocity_ += change_;
  ++passes_;
}

}  // namespace vesiflow::coupling
