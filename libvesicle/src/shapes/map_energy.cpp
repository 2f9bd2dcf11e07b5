// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/map_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "shapes/point.h"

namespace vesiflow::vesicle {
namespace {

/// Opposite to each corner.
std::array<double, 3> edge_lengths(const TriangleMesh& mesh, Eigen::Index t) {
  std::array<double, 3> lengths{};
  for (int k = 0; k < 3; ++k)
    lengths[std::size_t(k)] =
        (point(mesh.vertices, mesh.triangles(t, (k + 2) % 3)) - point(mesh.vertices, mesh.triangles(t, (k + 1) % 3)))
            .norm();
  return lengths;
}

/// A triangle on the sphere, as its chords span it.
struct Image {
  std::array<Vector3, 3> corner;
  std::array<Vector3, 3> edge;  ///< opposite to each corner, counterclockwise
  Vector3 twice_area;

  Image(const TriangleMesh& mesh, const VectorField& map, Eigen::Index t) {
    for (std::size_t k = 0; k < 3; ++k) corner[k] = point(map, mesh.triangles(t, Eigen::Index(k)));
    for (std::size_t k = 0; k < 3; ++k) edge[k] = corner[(k + 2) % 3] - corner[(k + 1) % 3];
    twice_area = edge[0].cross(edge[1]);
  }
  double area() const { return twice_area.norm() / 2; }
  bool is_outward() const { return corner[0].dot(corner[1].cross(corner[2])) > 0; }
  double dirichlet(const Eigen::Array<double, 1, 3>& cotangents) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += cotangents[Eigen::Index(k)] * edge[k].squaredNorm();
    return sum / 4;
  }
};

}  // namespace

MapEnergy::MapEnergy(const TriangleMesh& mesh)
    : mesh_(mesh), cotangents_(mesh.triangles.rows(), 3), area_(mesh.triangles.rows()) {
  // Needles have no usable angles: all edges are made longer by what leaves each triangle a slack of this part of the mean edge
  // (N. Sharp and K. Crane, Comput. Graph. Forum 39 (2020) 69). Nothing changes in a mesh without needles.
  constexpr double slack = 1e-4;
  double mean_edge = 0;
  for (Eigen::Index t = 0; t < area_.size(); ++t)
    for (const double length : edge_lengths(mesh, t)) mean_edge += length / (3 * double(area_.size()));
  double longer = 0;
  for (Eigen::Index t = 0; t < area_.size(); ++t) {
    const auto [a, b, c] = edge_lengths(mesh, t);
    longer = std::max(longer, slack * mean_edge - (a + b + c - 2 * std::max({a, b, c})));
  }
  for (Eigen::Index t = 0; t < area_.size(); ++t) {
    std::array<double, 3> l = edge_lengths(mesh, t);
    for (double& length : l) length += longer;
    const double half = (l[0] + l[1] + l[2]) / 2;
    area_[t] = std::sqrt(half * (half - l[0]) * (half - l[1]) * (half - l[2]));
    const double squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
    for (std::size_t k = 0; k < 3; ++k) cotangents_(t, Eigen::Index(k)) = (squares - 2 * l[k] * l[k]) / (4 * area_[t]);
  }
  area_ *= 4 * std::numbers::pi / area_.sum();
}

double MapEnergy::value(const VectorField& map) const {
  double energy = 0;
  for (Eigen::Index t = 0; t < area_.size(); ++t) {
    const Image image(mesh_, map, t);
    if (!image.is_outward()) return std::numeric_limits<double>::infinity();
    const double ratio = area_[t] / image.area();
    energy += image.dirichlet(cotangents_.row(t)) * (1 + ratio * ratio);
  }
  return energy;
}

void MapEnergy::gradient(const VectorField& map, VectorField& result) const {
  result.setZero(map.rows(), 3);
  for (Eigen::Index t = 0; t < area_.size(); ++t) {
    const Image image(mesh_, map, t);
    const double area = image.area();
    const double ratio = area_[t] / area;
    const double by_dirichlet = 1 + ratio * ratio;
    const double by_area = -2 * image.dirichlet(cotangents_.row(t)) * ratio * ratio / area;
    const Vector3 normal = image.twice_area.normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
      const Vector3 of_dirichlet = (cotangents_(t, Eigen::Index(next)) * image.edge[next] -
                                    cotangents_(t, Eigen::Index(last)) * image.edge[last]) /
                                   2;
      const Vector3 of_area = normal.cross(image.edge[k]) / 2;
      result.row(mesh_.triangles(t, Eigen::Index(k))) +=
          (by_dirichlet * of_dirichlet + by_area * of_area).transpose().array();
    }
  }
  result -= map.colwise() * (map * result).rowwise().sum();
}

Eigen::SparseMatrix<double> MapEnergy::stiffness(const VectorField& map) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(15 * area_.size()));
  for (Eigen::Index t = 0; t < area_.size(); ++t) {
    const Image image(mesh_, map, t);
    const double area = image.area();
    const double by_area = area_[t] / area * image.dirichlet(cotangents_.row(t)) / area;
    const double factor = 1 + by_area * by_area;
    for (int k = 0; k < 3; ++k) {
      const int a = mesh_.triangles(t, (k + 1) % 3), b = mesh_.triangles(t, (k + 2) % 3);
      const double weight = factor * cotangents_(t, k) / 2;
      for (const auto& [row, column, sign] : {std::tuple(a, a, 1), {b, b, 1}, {a, b, -1}, {b, a, -1}})
        entries.emplace_back(row, column, sign * weight);
      entries.emplace_back(a, a, factor * area / 3);
    }
  }
  Eigen::SparseMatrix<double> matrix(map.rows(), map.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace vesiflow::vesicle
