// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/smooth_interpolant.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "shapes/point.h"

namespace vesiflow::vesicle {
namespace {

VectorField vertex_normals(const TriangleMesh& mesh) {
  VectorField normals = VectorField::Zero(mesh.vertices.rows(), 3);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vector3 corner = point(mesh.vertices, mesh.triangles(t, k));
      const Vector3 a = point(mesh.vertices, mesh.triangles(t, (k + 1) % 3)) - corner;
      const Vector3 b = point(mesh.vertices, mesh.triangles(t, (k + 2) % 3)) - corner;
      const double squares = a.squaredNorm() * b.squaredNorm();
      if (squares > 0) normals.row(mesh.triangles(t, k)) += (a.cross(b) / squares).transpose().array();
    }
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    normals.row(i) = normals.row(i).matrix().normalized().array();  // zero stays zero: a flat edge
  return normals;
}

void add(AreaAndVolume& sum, const Vector3& a, const Vector3& b, const Vector3& c) {
  sum.area += (b - a).cross(c - a).norm() / 2;
  sum.volume += a.dot(b.cross(c)) / 6;
}

}  // namespace

SmoothInterpolant::SmoothInterpolant(const TriangleMesh& mesh) {
  const VectorField normals = vertex_normals(mesh);
  std::map<std::pair<int, int>, std::size_t> numbers;
  const auto edge = [&](int a, int b) -> const Edge& {
    const auto [entry, is_new] = numbers.try_emplace(std::minmax(a, b), edges.size());
    if (is_new) {
      const Vector3 from = point(mesh.vertices, a), to = point(mesh.vertices, b);
      const Vector3 at_from = point(normals, a), at_to = point(normals, b);
      const Vector3 bulge = ((from - to).dot(at_from) * at_from + (to - from).dot(at_to) * at_to) / 8;
      edges.push_back({a, b, (from + to) / 2 + bulge, (at_from + at_to).normalized(), bulge.norm()});
    }
    return edges[entry->second];
  };
  const Vector3 origin = mesh.vertices.colwise().mean().matrix().transpose();
  AreaAndVolume finer;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    std::array<Vector3, 3> corner, middle;  // middle: of the edge from corner k to the next
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      corner[std::size_t(k)] = point(mesh.vertices, a) - origin;
      middle[std::size_t(k)] = edge(a, b).middle - origin;
    }
    add(triangles, corner[0], corner[1], corner[2]);
    for (std::size_t k = 0; k < 3; ++k) add(finer, corner[k], middle[k], middle[(k + 2) % 3]);
    add(finer, middle[0], middle[1], middle[2]);
  }
  smooth.area = triangles.area + (finer.area - triangles.area) * 4 / 3;
  smooth.volume = triangles.volume + (finer.volume - triangles.volume) * 4 / 3;
}

}  // namespace vesiflow::vesicle
