// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// An ellipsoid of which all is known in closed form, for the tests of the sharp membrane.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "vesicle/sphere_grid.h"
#include "vesicle/types.h"

namespace vesiflow::coupling::test {

/// The points centre + map s of the directions s of the unit sphere: semi-axes, their directions and the poles of the mesh have
/// nothing to do with each other.
class Ellipsoid {
 public:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  /// Semi-axes along some directions that lie along no axis of a grid.
  Ellipsoid(const Vector& semi_axes, const Vector& centre)
      : map_(Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()) * Matrix(semi_axes.asDiagonal()) *
             Eigen::AngleAxisd(1.1, Vector(-2, 1, 1).normalized())),
        inverse_(map_.inverse()),
        form_(inverse_.transpose() * inverse_),
        centre_(centre),
        axes_(map_, Eigen::ComputeFullU) {}

  const Vector& centre() const { return centre_; }
  Vector point(const Vector& s) const { return centre_ + map_ * s; }
  Vector normal(const Vector& s) const { return (inverse_.transpose() * s).normalized(); }
  /// [i][j] = d(s_i)/d(x_j) along the surface.
  Matrix direction_gradient(const Vector& s) const { return inverse_ * projector(s); }
  /// grad_s n.
  Matrix shape(const Vector& s) const { return projector(s) * form_ * projector(s) / (form_ * map_ * s).norm(); }
  /// Least radius of curvature.
  double least_radius() const {
    const Vector a = axes_.singularValues();  // in descending order
    return a[2] * a[2] / a[0];
  }

  vesicle::VectorField markers(const vesicle::SphereGrid& grid) const {
    vesicle::VectorField x(grid.size(), 3);
    for (int j = 0; j < grid.latitudes(); ++j)
      for (int i = 0; i < grid.longitudes(); ++i) {
        const double sine = grid.sin_colatitude()[j], phi = grid.longitude(i);
        const Vector s(sine * std::cos(phi), sine * std::sin(phi), grid.cos_colatitude()[j]);
        x.row(grid.index(i, j)) = point(s).transpose().array();
      }
    return x;
  }

  /// Where the surface is closest to a point, and how far off, positive outside.
  struct Closest {
    Vector direction;
    double distance;
  };
  /// In the axes of the ellipsoid the closest point q to y has q_i = a_i^2 y_i/(a_i^2 + t): t by bisection of
  /// sum (q_i/a_i)^2 = 1, which decreases from the nearest pole on (D. Eberly, Distance from a point to an ellipse, an ellipsoid,
  /// or a hyperellipsoid, 2013).
  Closest closest(const Vector& x) const {
    const Vector a = axes_.singularValues();
    const Vector y = axes_.matrixU().transpose() * (x - centre_);
    const Vector ay = a.cwiseProduct(y.cwiseAbs());
    double low = ay[2] - a[2] * a[2], high = ay.norm() - a[2] * a[2];
    for (int step = 0; step < 100; ++step) {
      const double t = 0.5 * (low + high);
      const double sum = ay.cwiseQuotient((a.cwiseAbs2().array() + t).matrix()).squaredNorm();
      (sum > 1.0 ? low : high) = t;
    }
    const Vector q = a.cwiseAbs2().cwiseProduct(y).cwiseQuotient((a.cwiseAbs2().array() + low).matrix());
    const double side = y.cwiseQuotient(a).squaredNorm() > 1.0 ? 1.0 : -1.0;
    return {inverse_ * (axes_.matrixU() * q), side * (y - q).norm()};
  }

 private:
  Matrix projector(const Vector& s) const {
    const Vector n = normal(s);
    return Matrix::Identity() - n * n.transpose();
  }

  Matrix map_, inverse_, form_;
  Vector centre_;
  Eigen::JacobiSVD<Matrix> axes_;
};

}  // namespace vesiflow::coupling::test
