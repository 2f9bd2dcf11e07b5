// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "shapes/map_energy.h"

namespace vesiflow::vesicle {
namespace {

using Plane = Eigen::Array<double, Eigen::Dynamic, 2>;
using SparseSolver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// Every vertex but the corners of the given triangle at the mean of its neighbours.
Plane planar_embedding(const TriangleMesh& mesh, Eigen::Index outer) {
  const Eigen::Index vertices = mesh.vertices.rows();
  Plane positions = Plane::Zero(vertices, 2);
  std::vector<Eigen::Index> unknown(std::size_t(vertices), 0);
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * std::numbers::pi * k / 3;
    positions.row(mesh.triangles(outer, k)) << std::cos(angle), std::sin(angle);
    unknown[std::size_t(mesh.triangles(outer, k))] = -1;
  }
  Eigen::Index unknowns = 0;
  for (Eigen::Index& number : unknown)
    if (number >= 0) number = unknowns++;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  // Each edge is met once in each direction.
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles(t, k), to = mesh.triangles(t, (k + 1) % 3);
      const Eigen::Index row = unknown[std::size_t(from)], column = unknown[std::size_t(to)];
      if (row < 0) continue;
      entries.emplace_back(row, row, 1.0);
      if (column >= 0)
        entries.emplace_back(row, column, -1.0);
      else
        right.row(row) += positions.row(to).matrix();
    }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const SparseSolver solver(matrix);
  if (solver.info() != Eigen::Success)
    throw std::domain_error(
        "triangle mesh: the equations of its map to the sphere are singular: every vertex must belong to triangles, "
        "and all of them to one surface");
  const Eigen::MatrixX2d solution = solver.solve(right);
  for (Eigen::Index i = 0; i < vertices; ++i)
    if (unknown[std::size_t(i)] >= 0) positions.row(i) = solution.row(unknown[std::size_t(i)]).array();
  return positions;
}

void project(VectorField& map) {
  map.colwise() /= map.square().rowwise().sum().sqrt().eval();
}

double median(Eigen::ArrayXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Stereographic projection from the north pole, with half of the vertices on each hemisphere. The plane is seen from
/// outside the sphere turned over, hence the sign.
VectorField on_sphere(Plane z) {
  for (int k = 0; k < 2; ++k) z.col(k) -= median(z.col(k));
  z /= median(z.matrix().rowwise().norm());
  const Eigen::ArrayXd squares = z.square().rowwise().sum();
  VectorField map(z.rows(), 3);
  map << 2 * z.col(0) / (1 + squares), 2 * z.col(1) / (1 + squares), (squares - 1) / (1 + squares);
  return map;
}

/// The embedding has no folds, but seen from the centre of the sphere its largest triangles, next to the one left out, may.
/// There, and where triangles are all but flat, the mean of its neighbours is a better place for a vertex. This is done for as
/// long as the energy falls: repeated too often, it draws all vertices together. Returns the energy, infinite if folds are left.
double unfold(const TriangleMesh& mesh, VectorField& map) {
  constexpr int most_sweeps = 300;
  const MapEnergy energy(mesh);
  double now = energy.value(map);
  VectorField trial;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    trial.setZero(map.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) trial.row(mesh.triangles(t, k)) += map.row(mesh.triangles(t, (k + 1) % 3));
    project(trial);
    trial.rowwise() -= trial.colwise().mean().eval();
    project(trial);
    const double next = energy.value(trial);
    if (std::isfinite(now) && !(next < now)) break;
    map = trial;
    now = next;
  }
  return now;
}

/// Moves down the energy by conjugate gradients in the metric of its stiffness.
void relax(const TriangleMesh& mesh, VectorField& map) {
  constexpr int most_steps = 300;
  constexpr double least_gain = 1e-7;  // of the energy, in a step
  const MapEnergy energy(mesh);
  SparseSolver solver;
  solver.analyzePattern(energy.stiffness(map));
  double now = energy.value(map);
  VectorField gradient, direction, previous_gradient, trial;
  double previous_norm = 0;
  bool is_restarted = true;
  for (int step = 0, idle = 0; step < most_steps && idle < 3; ++step) {
    energy.gradient(map, gradient);
    solver.factorize(energy.stiffness(map));
    if (solver.info() != Eigen::Success) break;  // the map is one-to-one already, only not the best
    VectorField descent = -solver.solve(gradient.matrix()).array();
    descent -= map.colwise() * (map * descent).rowwise().sum();
    const double norm = -(descent * gradient).sum();
    if (is_restarted) {
      direction = descent;
    } else {
      const double beta = std::max(0.0, (norm + (descent * previous_gradient).sum()) / previous_norm);
      direction = descent + beta * direction;
      direction -= map.colwise() * (map * direction).rowwise().sum();
      if (!((direction * gradient).sum() < 0)) direction = descent;
    }
    const double slope = (direction * gradient).sum();
    double length = 1, next = now;
    for (; length > 1e-10; length /= 2) {
      trial = map + length * direction;
      project(trial);
      next = energy.value(trial);
      if (next <= now + 1e-4 * length * slope) break;
    }
    if (!(next < now)) {
      if (is_restarted) break;
      is_restarted = true;  // down the steepest way, where the way before is of no use
      continue;
    }
    is_restarted = false;
    map = trial;
    idle = now - next < least_gain * now ? idle + 1 : 0;
    now = next;
    previous_gradient = gradient;
    previous_norm = norm;
  }
}

}  // namespace

bool is_one_to_one(const TriangleMesh& mesh, const VectorField& map) {
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = map.row(mesh.triangles(t, k)).matrix().transpose();
    if (!(corners.determinant() > 0)) return false;
  }
  return true;
}

VectorField sphere_map(const TriangleMesh& mesh) {
  constexpr Eigen::Index most_trials = 4;  // of the triangle that is left out
  const Eigen::Index triangles = mesh.triangles.rows();
  double least_energy = std::numeric_limits<double>::infinity();
  VectorField best;
  for (Eigen::Index trial = 0; trial < std::min(most_trials, triangles); ++trial) {
    VectorField map = on_sphere(planar_embedding(mesh, trial * triangles / most_trials));
    const double energy = unfold(mesh, map);
    if (!(energy < least_energy)) continue;
    least_energy = energy;
    best = map;
  }
  if (best.size() == 0)
    throw std::domain_error(
        "triangle mesh: no map to the sphere without folds was found; remesh the surface so that its triangles are of "
        "like "
        "sizes and nearly equilateral");
  relax(mesh, best);
  return best;
}

}  // namespace vesiflow::vesicle
