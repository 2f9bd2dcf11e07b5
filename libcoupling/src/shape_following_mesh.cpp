// The velocity W of the mesh: that of the shape, its rigid motion, and the way back to a good mesh.
#include <algorithm>
#include <array>
#include <cmath>

#include "shape_following.h"
#include "vesicle/redistribution.h"
#include "vesicle/rigid_motion.h"

namespace vesiflow::coupling {
namespace {

using vesicle::Surface;
using vesicle::VectorField;

// lambda: while the membrane moves by its radius the mesh relaxes e times, but no faster than by a tenth in a step. At reduced volume
// 0.7 rates of 0.5 to 4 times the shear rate are alike in noise and steady state, and a third in a step is unstable at Ca = 30.
constexpr double relaxation = 1.0, largest_share = 0.1;

// The mesh turns at this many times the membrane's greatest speed over its radius at most. A shape that deviates by f from a sphere turns
// at about 1/f of the rate of strain when its axes change: no material does, and a mesh that turns by an angle a in a step is off by a^2/2.
// From 0.99 on shapes turn by less than 3 times (from 0.9 on by 1.1).
constexpr double fastest_turning = 3.0;

template <typename Factor>
void scale_degrees(vesicle::Coefficients& c, Factor factor) {
  for (int n = 0; n < c.degrees(); ++n) {
    const double f = factor(n);
    for (int m = 0; m <= n; ++m)
      for (int i = 0; i < c.fields(); ++i) c(i, n, m) *= f;
  }
}

void make_tangential(const Surface& surface, VectorField& field) {
  const VectorField& n = surface.normal();
  for (Eigen::Index m = 0; m < field.rows(); ++m) {
    const double normal = (field.row(m) * n.row(m)).sum();
    field.row(m) -= normal * n.row(m);
  }
}

}  // namespace

void ShapeFollowing::mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) {
  find_mesh_velocity(dt, membrane.surface(), velocities);
  velocities.membrane = velocity_;
}

// U with the resolved degrees, and W.
void ShapeFollowing::find_mesh_velocity(double dt, const Surface& surface, const MarkerVelocities& velocities) {
  harmonics_.analysis(velocities.fluid, velocity_coefficients_);
  harmonics_.synthesis(velocity_coefficients_, velocity_);
  normal_velocity_ = (velocity_ * surface.normal()).rowwise().sum();
  const vesicle::RigidMotion rigid = vesicle::rigid_motion_of_shape(surface, normal_velocity_);
  const auto& v = rigid.velocity;
  double largest_square = 0.0;
  for (Eigen::Index m = 0; m < velocity_.rows(); ++m) {
    double square = 0.0;
    for (int i = 0; i < 3; ++i) square += (velocity_(m, i) - v(i)) * (velocity_(m, i) - v(i));
    largest_square = std::max(largest_square, square);
  }
  largest_speed_ = std::sqrt(largest_square);
  const double turning_speed = radius_ * rigid.angular_velocity.norm();
  const double fastest = fastest_turning * largest_speed_;
  const vesicle::Vector3 omega = turning_speed > fastest
                                     ? vesicle::Vector3(fastest / turning_speed * rigid.angular_velocity)
                                     : rigid.angular_velocity;
  for (Eigen::Index m = 0; m < mesh_velocity_.rows(); ++m) {
    std::array<double, 3> r, along;
    for (int i = 0; i < 3; ++i) r[i] = surface.positions()(m, i) - rigid.centre(i);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      along[i] = v(i) + omega(j) * r[k] - omega(k) * r[j];
    }
    double excess = normal_velocity_(m);
    for (int i = 0; i < 3; ++i) excess -= along[i] * surface.normal()(m, i);
    for (int i = 0; i < 3; ++i) mesh_velocity_(m, i) = along[i] + excess * surface.normal()(m, i);
  }
  relax_mesh(dt, surface);
}

// The greatest ratio of a length on the sphere of the same area to that of its image on the membrane, along the coordinates; at least 1.
double ShapeFollowing::greatest_compression(const Surface& surface) const {
  const vesicle::SphereGrid& grid = surface.grid();
  double largest = 0.0;
  for (int j = 0; j < grid.latitudes(); ++j) {
    const double sine = grid.sin_colatitude()[j];
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index m = grid.index(i, j);
      largest = std::max({largest, surface.geometry().dual_theta().row(m).square().sum(),
                          surface.geometry().dual_phi().row(m).square().sum() * sine * sine});
    }
  }
  return std::max(1.0, radius_ * std::sqrt(largest));
}

// The direction is that of steepest descent of the mesh energy in the norm of its own second derivative, so that all degrees relax at about the same
// rate. Degrees 0 and 1 have no weight of their own in it and take that of degree 2, the lowest that they meet there.
void ShapeFollowing::relax_mesh(double dt, const Surface& surface) {
  const double rate = std::min(relaxation * largest_speed_ / radius_, largest_share / dt);
  vectors_ = surface.positions();
  harmonics_.analysis(vectors_, velocity_coefficients_);
  scale_degrees(velocity_coefficients_, [](int n) { return -vesicle::mesh_energy_weight(n); });
  harmonics_.synthesis(velocity_coefficients_, vectors_);
  make_tangential(surface, vectors_);
  harmonics_.analysis(vectors_, velocity_coefficients_);
  scale_degrees(velocity_coefficients_, [](int n) { return 1.0 / vesicle::mesh_energy_weight(std::max(2, n)); });
  harmonics_.synthesis(velocity_coefficients_, vectors_);
  make_tangential(surface, vectors_);
  mesh_velocity_ += rate * vectors_;
}

}  // namespace vesiflow::coupling
