// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle::testing {

inline TriangleMesh mesh_of(const std::vector<Vector3>& vertices, const std::vector<std::array<int, 3>>& triangles) {
  TriangleMesh mesh{VectorField(vertices.size(), 3), {}};
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i].transpose().array();
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return mesh;
}

/// Octahedron on the unit sphere, each triangle split in four `times` times: 4^(times + 1) + 2 vertices. It has the
/// symmetries of the octahedron: a central one among them.
inline TriangleMesh octasphere(int times) {
  std::vector<Vector3> x{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> triangles;
  for (int k = 0; k < 4; ++k) {
    triangles.push_back({k, (k + 1) % 4, 4});
    triangles.push_back({(k + 1) % 4, k, 5});
  }
  for (int pass = 0; pass < times; ++pass) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(x.size()));
      if (is_new) x.push_back((x[std::size_t(a)] + x[std::size_t(b)]).normalized());
      return entry->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const std::array<int, 3>& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    triangles = finer;
  }
  return mesh_of(x, triangles);
}

/// The mesh with its vertices at shape(vertex).
template <class Shape>
TriangleMesh mapped(TriangleMesh mesh, const Shape& shape) {
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    const Vector3 moved = shape(Vector3(mesh.vertices.row(i).matrix().transpose()));
    mesh.vertices.row(i) = moved.transpose().array();
  }
  return mesh;
}

/// Evans-Fung disc of radius 1, see biconcave_disc().
inline Vector3 red_cell(const Vector3& d) {
  const double rho = d.x() * d.x() + d.y() * d.y();
  return {d.x(), d.y(), d.z() / 2 * (0.207161 + 2.002558 * rho - 1.122762 * rho * rho)};
}

/// A disc of semi-axes 1.6 and 0.25 bent over a sphere of radius 0.9, which it covers down to 102 degrees from the top: a bowl
/// that is not star-shaped about any point.
inline Vector3 stomatocyte(const Vector3& d) {
  const double rho = std::hypot(d.x(), d.y()), angle = 1.6 / 0.9 * rho, radius = 0.9 + 0.25 * d.z();
  const double across = rho > 0 ? radius * std::sin(angle) / rho : 0;
  return {across * d.x(), across * d.y(), radius * std::cos(angle)};
}

/// Genus one; radii 2 and 1 about z.
inline TriangleMesh torus(int around, int across) {
  std::vector<Vector3> x;
  std::vector<std::array<int, 3>> triangles;
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double rho = 2 + std::cos(v);
      x.emplace_back(rho * std::cos(u), rho * std::sin(u), std::sin(v));
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh_of(x, triangles);
}

/// Both meshes as one list of vertices and triangles.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh both{VectorField(a.vertices.rows() + b.vertices.rows(), 3), {}};
  both.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  both.vertices << a.vertices, b.vertices;
  both.triangles << a.triangles, b.triangles + static_cast<int>(a.vertices.rows());
  return both;
}

}  // namespace vesiflow::vesicle::testing
