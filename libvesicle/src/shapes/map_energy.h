// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>

#include "vesicle/triangle_mesh.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Energy of a map from a triangle mesh to the unit sphere, the symmetric Dirichlet energy of J. Schreiner, A. Asirvatham,
/// E. Praun and H. Hoppe, ACM Trans. Graph. 23 (2004) 870: with the mesh scaled to the area of the sphere,
///   E = sum over triangles of A (s1^2 + s2^2 + 1/s1^2 + 1/s2^2)/2 = sum D (1 + (A/a)^2),
/// s1, s2 the principal stretches of a triangle, A and a its area on the mesh and on the sphere, D = A (s1^2 + s2^2)/2
/// its Dirichlet energy. It is 2 A where the map is an isometry and infinite where a triangle collapses.
class MapEnergy {
 public:
  explicit MapEnergy(const TriangleMesh& mesh);

  /// map: unit vectors, shape (vertices, 3). Infinite if a triangle is turned over.
  double value(const VectorField& map) const;

  /// Derivatives by the positions, tangential to the sphere.
  void gradient(const VectorField& map, VectorField& result) const;

  /// Positive definite, the same for each component: the Hessian of sum D (1 + (A D/a^2)^2) at fixed factors of D, with a
  /// mass that keeps the constants from being free. It grows as that of E does where a triangle is flattened or sheared: a
  /// displacement changes a by at most 2 sqrt(D) times the root of its own Dirichlet energy, and d^2 E/da^2 is 6 D A^2/a^4.
  Eigen::SparseMatrix<double> stiffness(const VectorField& map) const;

 private:
  const TriangleMesh& mesh_;
  Eigen::Array<double, Eigen::Dynamic, 3> cotangents_;  // at the corners of each triangle
  Eigen::ArrayXd area_;
};

}  // namespace vesiflow::vesicle
