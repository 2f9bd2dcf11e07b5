// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/rigid_motion.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {

RigidMotion rigid_motion_of_shape(const Surface& surface, const ScalarField& normal_velocity) {
  check_markers(normal_velocity, "normal_velocity", surface.grid().size());
  check_finite(normal_velocity, "a normal velocity");
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  RigidMotion motion;
  motion.centre = surface.integral(surface.positions()) / surface.area();

  Matrix6 normal_matrix = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();
  double square_radius = 0;
  for (Eigen::Index k = 0; k < normal_velocity.rows(); ++k) {
    const double weight = surface.area_weight()(k);
    Vector6 share;  // what V and Omega add to the normal velocity here: n, r x n
    Vector3 r;
    for (int axis = 0; axis < 3; ++axis) {
      share(axis) = surface.normal()(k, axis);
      r(axis) = surface.positions()(k, axis) - motion.centre(axis);
    }
    share(3) = r(1) * share(2) - r(2) * share(1);
    share(4) = r(2) * share(0) - r(0) * share(2);
    share(5) = r(0) * share(1) - r(1) * share(0);
    normal_matrix.selfadjointView<Eigen::Lower>().rankUpdate(share, weight);
    right_side += weight * normal_velocity(k) * share;
    square_radius += weight * r.squaredNorm();
  }
  constexpr double damping = 1e-6;
  normal_matrix.diagonal().head<3>().array() += damping * surface.area();
  normal_matrix.diagonal().tail<3>().array() += damping * square_radius;
  const Vector6 solution = normal_matrix.selfadjointView<Eigen::Lower>().llt().solve(right_side);
  motion.velocity = solution.head<3>();
  motion.angular_velocity = solution.tail<3>();
  return motion;
}

}  // namespace vesiflow::vesicle
