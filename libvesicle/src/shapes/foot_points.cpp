// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/foot_points.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "harmonics/directions.h"
#include "vesicle/point_evaluation.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::vesicle {

FootPoints::FootPoints(const Coefficients& surface) : surface_(surface) {
  const int degrees = surface.degrees();
  const SphereGrid grid(degrees + 1);
  Eigen::ArrayXXd theta(grid.size(), 3), phi(grid.size(), 3), gradients(grid.size(), 9);
  SphericalHarmonics(degrees, grid).gradient(surface, theta, phi);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index k = grid.index(i, j);
      const double s = grid.sin_colatitude()[j], c = grid.cos_colatitude()[j], at = grid.longitude(i);
      const Vector3 south(c * std::cos(at), c * std::sin(at), -s), east(-std::sin(at), std::cos(at), 0);
      for (int field = 0; field < 3; ++field)
        gradients.row(k).segment<3>(3 * field) =
            (theta(k, field) * south + phi(k, field) / s * east).transpose().array();
    }
  SphericalHarmonics(degrees + 1, grid, 9).analysis(gradients, gradients_);
}

void FootPoints::find(const VectorField& places, const VectorField& points, VectorField& displacement,
                      VectorField& across) const {
  const PointEvaluation evaluation(gradients_.degrees());
  Eigen::ArrayXXd positions(places.rows(), 3), gradients(places.rows(), 9);
  evaluation.values_at(surface_, places, positions);
  evaluation.values_at(gradients_, places, gradients);
  displacement.resize(places.rows(), 3);
  across.resize(places.rows(), 3);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Vector3 place = places.row(i).matrix().transpose();
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = place.unitOrthogonal();
    plane.col(1) = place.cross(plane.col(0));
    Eigen::Matrix3d jacobian;
    for (int field = 0; field < 3; ++field) jacobian.row(field) = gradients.row(i).segment<3>(3 * field).matrix();
    const Eigen::Matrix<double, 3, 2> tangents = jacobian * plane;
    const Vector3 residual = (points.row(i) - positions.row(i)).matrix().transpose();
    const Eigen::Vector2d step = tangents.colPivHouseholderQr().solve(residual);
    displacement.row(i) = (plane * step).transpose().array();
    across.row(i) = (residual - tangents * step).transpose().array();
  }
}

}  // namespace vesiflow::vesicle
