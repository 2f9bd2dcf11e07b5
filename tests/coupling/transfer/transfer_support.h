// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Grids, markers and fields for the tests of MarkerTransfer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "coupling/marker_transfer.h"

namespace vesiflow::coupling::test {

using vesicle::ScalarField;
using vesicle::VectorField;

enum class AxisKind { walls, periodic, mirror };

/// One arrangement of axes, on a grid with three different widths and numbers of cells.
struct Box {
  std::array<AxisKind, 3> kinds;

  bool is(int axis, AxisKind kind) const { return kinds[static_cast<std::size_t>(axis)] == kind; }
  std::array<bool, 3> all(AxisKind kind) const { return {is(0, kind), is(1, kind), is(2, kind)}; }
  fluid::Grid grid() const {
    return {{-1.0, -2.0, 0.0}, {2.0, 1.5, 2.5}, {13, 12, 9}, {all(AxisKind::periodic), all(AxisKind::mirror)}};
  }
  MarkerTransfer transfer(DeltaKernel kernel) const { return MarkerTransfer(grid(), kernel); }
  std::string describe() const {
    std::string text;
    for (const AxisKind kind : kinds) text += kind == AxisKind::walls ? 'w' : kind == AxisKind::periodic ? 'p' : 'm';
    return text;
  }
};

/// How an axis is written in tests.
namespace letters {
inline constexpr AxisKind w = AxisKind::walls, p = AxisKind::periodic, m = AxisKind::mirror;
inline constexpr std::array<Box, 8> boxes{
    {{{w, w, w}}, {{p, w, w}}, {{w, p, p}}, {{p, p, p}}, {{m, w, w}}, {{p, m, p}}, {{w, m, m}}, {{m, m, m}}}};
}  // namespace letters

/// Markers wherever the box allows them: up to the walls' limits, in several periodic boxes, on both sides of mirrors; the
/// first ones on special positions (points, half points, a mirror plane, the seam of a periodic axis).
inline VectorField markers_in(const Box& box, DeltaKernel kernel, int count) {
  const fluid::Grid grid = box.grid();
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  VectorField x(count, 3);
  for (int axis = 0; axis < 3; ++axis) {
    const double n = grid.cells[axis], d = wall_clearance(kernel);
    const double low = box.is(axis, letters::w) ? d : box.is(axis, letters::p) ? -2.0 * n : d - n;
    const double high = box.is(axis, letters::p) ? 3.0 * n : n - d;
    for (int i = 0; i < count; ++i) {
      double s = low + unit(generator) * (high - low);
      if (i < 12 && (i + axis) % 3 == 0) s = 0.5 * std::floor(2.0 * s);
      if (i < 12 && (i + axis) % 3 == 1) s = box.is(axis, letters::w) ? 0.5 * n : 0.5 * (i / 3);
      if (!box.is(axis, letters::p)) s = std::clamp(s, low + 1e-9, high - 1e-9);
      x(i, axis) = grid.lower[axis] + s * grid.spacing(axis);
    }
  }
  return x;
}

/// Number of points along an axis, each counted once.
inline int distinct_points(const fluid::Grid& grid, fluid::Centring centring, int axis) {
  return grid.periodic[axis] ? grid.cells[axis] : fluid::point_extent(grid, centring)[axis];
}

/// Calls function(value, position, component) at every point of a vector field, each once.
template <class Vector, class Function>
void for_each_point(Vector& field, const Function& function) {
  const auto visit = [&](auto& component, int number) {
    const auto& grid = component.grid();
    const auto centring = std::decay_t<decltype(component)>::centring;
    for (int k = 0; k < distinct_points(grid, centring, 2); ++k)
      for (int j = 0; j < distinct_points(grid, centring, 1); ++j)
        for (int i = 0; i < distinct_points(grid, centring, 0); ++i)
          function(component.row(j, k)[i], component.position(i, j, k), number);
  };
  visit(field.x, 0);
  visit(field.y, 1);
  visit(field.z, 2);
}

/// Normally distributed at every point, each once; not a number at ghosts and repeated faces: nobody may read these.
inline fluid::FaceVector random_field(const fluid::Grid& grid) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  fluid::FaceVector field(grid);
  field.fill(std::numeric_limits<double>::quiet_NaN());
  for_each_point(field, [&](double& value, const fluid::Vector3&, int) { value = normal(generator); });
  return field;
}

/// Sum of products over all points, each once.
inline double dot(const fluid::FaceVector& a, const fluid::FaceVector& b) {
  std::vector<double> values;
  for_each_point(a, [&](double value, const fluid::Vector3&, int) { values.push_back(value); });
  double sum = 0.0;
  std::size_t next = 0;
  for_each_point(b, [&](double value, const fluid::Vector3&, int) { sum += value * values[next++]; });
  return sum;
}

}  // namespace vesiflow::coupling::test
