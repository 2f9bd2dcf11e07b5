// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "shapes/vertex_numbers.h"

namespace vesiflow::vesicle {
namespace {

std::string number(Eigen::Index i) {
  return std::to_string(i);
}

[[noreturn]] void refuse(const std::string& what) {
  throw std::domain_error("triangle mesh: " + what);
}

void check_vertices(const TriangleMesh& mesh) {
  const VectorField& x = mesh.vertices;
  if (x.rows() < 4) refuse(number(x.rows()) + " vertices: a closed surface needs at least 4");
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    if (!x.row(i).allFinite()) refuse("vertex " + number(i) + " is not finite");
  const auto coordinates = [&x](Eigen::Index i) { return std::tuple(x(i, 0), x(i, 1), x(i, 2)); };
  std::vector<Eigen::Index> order(static_cast<std::size_t>(x.rows()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, coordinates);
  const auto pair = std::ranges::adjacent_find(order, {}, coordinates);
  if (pair != order.end())
    refuse("vertices " + number(*pair) + " and " + number(*(pair + 1)) +
           " are at the same point: merge them if the mesh was only split there; if not, the surface touches itself");
}

void check_vertex_number(const TriangleMesh& mesh, Eigen::Index triangle, int vertex) {
  if (vertex >= 0 && vertex < mesh.vertices.rows()) return;
  refuse("triangle " + number(triangle) + " has vertex " + number(vertex) + ": must be in [0, " +
         number(mesh.vertices.rows() - 1) + "]");
}

void check_corners(const TriangleMesh& mesh) {
  std::vector<bool> is_used(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto corner = mesh.triangles.row(t);
    for (int k : corner) {
      check_vertex_number(mesh, t, k);
      is_used[static_cast<std::size_t>(k)] = true;
    }
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
      refuse("triangle " + number(t) + " has a vertex twice");
  }
  const auto unused = std::ranges::find(is_used, false);
  if (unused != is_used.end()) refuse("vertex " + number(unused - is_used.begin()) + " belongs to no triangle");
}

/// The triangle across an edge, and whether both run along the edge in opposite directions, as neighbours on an
/// oriented surface do.
struct Neighbour {
  Eigen::Index triangle = 0;
  bool agrees = true;
};

/// [triangle][k]: across the edge from corner k to corner k + 1.
using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours_of(const TriangleMesh& mesh) {
  struct Side {
    int low, high;
    bool forward;
    Eigen::Index triangle;
    std::size_t k;
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
  };
  std::vector<Side> sides;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles(t, k);
      const int to = mesh.triangles(t, (k + 1) % 3);
      sides.push_back({std::min(from, to), std::max(from, to), from < to, t, static_cast<std::size_t>(k)});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.triangle); });
  Neighbours neighbours(static_cast<std::size_t>(mesh.triangles.rows()));
  for (auto a = sides.begin(); a != sides.end(); a += 2) {
    const std::string edge = "edge between vertices " + number(a->low) + " and " + number(a->high);
    const auto last = std::find_if(a, sides.end(), [&](const Side& s) { return !s.same_edge(*a); });
    if (last - a == 1) refuse(edge + " is open: only triangle " + number(a->triangle) + " has it");
    if (last - a > 2) refuse(edge + " belongs to " + number(last - a) + " triangles: must be two");
    const auto b = a + 1;
    const bool agrees = a->forward != b->forward;
    neighbours[std::size_t(a->triangle)][a->k] = {b->triangle, agrees};
    neighbours[std::size_t(b->triangle)][b->k] = {a->triangle, agrees};
  }
  return neighbours;
}

/// Walks over the whole surface, turning triangles around where they disagree with the neighbour they were reached
/// from.
void check_one_oriented_component(const Neighbours& neighbours) {
  enum class Turn { unknown, as_is, reversed };
  const auto opposite = [](Turn turn) { return turn == Turn::as_is ? Turn::reversed : Turn::as_is; };
  std::vector<Turn> turns(neighbours.size(), Turn::unknown);
  std::vector<Eigen::Index> reached{0};
  turns[0] = Turn::as_is;
  for (std::size_t visited = 0; visited < reached.size(); ++visited) {
    const Turn turn = turns[std::size_t(reached[visited])];
    for (const Neighbour& n : neighbours[std::size_t(reached[visited])]) {
      Turn& there = turns[std::size_t(n.triangle)];
      const Turn expected = n.agrees ? turn : opposite(turn);
      if (there == Turn::unknown) {
        there = expected;
        reached.push_back(n.triangle);
      } else if (there != expected) {
        refuse("the surface is one-sided: no way to turn its triangles makes neighbours agree");
      }
    }
  }
  if (reached.size() != neighbours.size())
    refuse("more than one component: only " + std::to_string(reached.size()) + " of " +
           std::to_string(neighbours.size()) + " triangles hang together with triangle 0");
  const auto reversed = static_cast<std::size_t>(std::ranges::count(turns, Turn::reversed));
  if (reversed == 0) return;
  const bool few = 2 * reversed <= turns.size();
  const auto first = std::ranges::find(turns, few ? Turn::reversed : Turn::as_is) - turns.begin();
  refuse("triangle " + number(first) + " is inside out: it turns the other way than most (" +
         std::to_string(few ? reversed : turns.size() - reversed) + " of " + std::to_string(turns.size()) +
         " do); exchange two of its vertices");
}

/// Around each vertex the triangles must form a single fan.
void check_fans(const TriangleMesh& mesh, const Neighbours& neighbours) {
  const auto corner_of = [&mesh](Eigen::Index t, Eigen::Index vertex) {
    return mesh.triangles(t, 0) == vertex ? 0 : mesh.triangles(t, 1) == vertex ? 1 : 2;
  };
  std::vector<int> triangles(static_cast<std::size_t>(mesh.vertices.rows()));
  std::vector<Eigen::Index> any_triangle(triangles.size());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (int vertex : mesh.triangles.row(t)) {
      ++triangles[std::size_t(vertex)];
      any_triangle[std::size_t(vertex)] = t;
    }
  for (Eigen::Index vertex = 0; vertex < mesh.vertices.rows(); ++vertex) {
    const Eigen::Index start = any_triangle[std::size_t(vertex)];
    int fan = 0;
    Eigen::Index t = start;
    do {
      ++fan;
      t = neighbours[std::size_t(t)][std::size_t(corner_of(t, vertex))].triangle;
    } while (t != start);
    if (fan != triangles[std::size_t(vertex)])
      refuse("the surface touches itself in vertex " + number(vertex) + ": its triangles form more than one fan");
  }
}

}  // namespace

void check_vertex_numbers(const TriangleMesh& mesh) {
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
    for (const int vertex : mesh.triangles.row(t)) check_vertex_number(mesh, t, vertex);
}

void check_closed_genus_zero(const TriangleMesh& mesh) {
  check_vertices(mesh);
  check_corners(mesh);
  const Neighbours neighbours = neighbours_of(mesh);
  check_one_oriented_component(neighbours);
  check_fans(mesh, neighbours);
  // Closed and oriented: V - E + F = 2 - 2 genus with E = 3 F / 2.
  const Eigen::Index characteristic = mesh.vertices.rows() - mesh.triangles.rows() / 2;
  if (characteristic != 2)
    refuse("V - E + F = " + number(characteristic) + ": must be 2; the surface has " +
           number((2 - characteristic) / 2) + " handle(s), a vesicle here must have the topology of a sphere");
}

EnclosedVolume enclosed_volume(const TriangleMesh& mesh) {
  check_vertex_numbers(mesh);
  // About a point of the surface's box: sums of nearly equal terms of either sign would lose digits far from the
  // origin.
  const Vector3 origin = mesh.vertices.colwise().mean().matrix().transpose();
  EnclosedVolume result;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    Eigen::Matrix3d corner;
    for (int k = 0; k < 3; ++k) corner.col(k) = mesh.vertices.row(mesh.triangles(t, k)).matrix().transpose() - origin;
    const double volume = corner.col(0).dot(corner.col(1).cross(corner.col(2))) / 6;
    result.volume += volume;
    result.centroid += volume / 4 * corner.rowwise().sum();
  }
  result.centroid = origin + result.centroid / result.volume;
  return result;
}

}  // namespace vesiflow::vesicle
