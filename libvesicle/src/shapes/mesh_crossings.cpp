// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "shapes/vertex_numbers.h"
#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {
namespace {

using Corners = std::array<Vector3, 3>;

/// Six times the volume of the tetrahedron.
double orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return (a - d).dot((b - d).cross(c - d));
}

bool segment_crosses(const Vector3& p, const Vector3& q, const Corners& t) {
  if (!(orientation(t[0], t[1], t[2], p) * orientation(t[0], t[1], t[2], q) < 0)) return false;
  const double a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]), c = orientation(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool cross(const Corners& s, const Corners& t) {
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_crosses(s[k], s[(k + 1) % 3], t) || segment_crosses(t[k], t[(k + 1) % 3], s)) return true;
  return false;
}

struct Box {
  Eigen::Array3d low, high;
};

}  // namespace

void check_no_crossings(const TriangleMesh& mesh) {
  check_vertex_numbers(mesh);
  const auto triangles = static_cast<std::size_t>(mesh.triangles.rows());
  std::vector<Corners> corners(triangles);
  std::vector<Box> boxes(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      corners[t][k] = mesh.vertices.row(mesh.triangles(Eigen::Index(t), Eigen::Index(k))).matrix().transpose();
    const auto& [a, b, c] = corners[t];
    boxes[t] = {a.cwiseMin(b).cwiseMin(c).array(), a.cwiseMax(b).cwiseMax(c).array()};
  }
  const auto share_a_vertex = [&mesh](std::size_t s, std::size_t t) {
    for (const int a : mesh.triangles.row(Eigen::Index(s)))
      for (const int b : mesh.triangles.row(Eigen::Index(t)))
        if (a == b) return true;
    return false;
  };
  // Along an axis, a triangle meets those that begin before it ends: the fewest where the mesh is longest.
  if (triangles == 0) return;
  Eigen::Index axis = 0;
  (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff(&axis);
  std::vector<std::size_t> order(triangles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&boxes, axis](std::size_t t) { return boxes[t].low[axis]; });
  for (auto first = order.begin(); first != order.end(); ++first)
    for (auto second = first + 1; second != order.end(); ++second) {
      const Box &a = boxes[*first], &b = boxes[*second];
      if (b.low[axis] > a.high[axis]) break;
      if ((b.low > a.high).any() || (a.low > b.high).any() || share_a_vertex(*first, *second)) continue;
      if (!cross(corners[*first], corners[*second])) continue;
      throw std::domain_error("triangle mesh: triangles " + std::to_string(std::min(*first, *second)) + " and " +
                              std::to_string(std::max(*first, *second)) +
                              " cut through each other: the surface must not cross itself");
    }
}

}  // namespace vesiflow::vesicle
