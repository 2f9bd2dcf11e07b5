// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole box that a grid with mirrors stands for, and fields and flows that are symmetric in it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "fluid/field.h"
#include "test_fields.h"
#include "test_problems.h"

namespace vesiflow::fluid::test {

// Whose mirrors, if it has any, are at zero; cells of all kinds of numbers: odd, prime, even.
inline Grid part_of_box(int mirrors, const std::array<int, 3>& cells = {7, 5, 6}) {
  const auto mirror = axes_of(mirrors);
  Grid grid({-0.7, -0.6, -0.8}, {1.2, 1.1, 0.9}, cells);
  for (int axis = 0; axis < 3; ++axis) {
    if (mirror[axis]) grid.lower[axis] = 0.0;
  }
  grid.mirror = mirror;
  return grid;
}

inline Grid whole_box(const Grid& part) {
  Grid whole = part;
  for (int axis = 0; axis < 3; ++axis) {
    if (!part.mirror[axis]) continue;
    whole.lower[axis] = part.lower[axis] - part.length(axis);
    whole.cells[axis] = 2 * part.cells[axis];
  }
  whole.mirror = {false, false, false};
  return whole;
}

// Index in the part of the point `index` of the whole, along an axis, and -1 if the value there changes its sign.
struct Reflected {
  int index, sign;
};
inline Reflected reflected(const Grid& part, Centring centring, int axis, int index) {
  if (!part.mirror[axis]) return {index, 1};
  const int here = index - part.cells[axis];
  if (here >= 0) return {here, 1};
  return is_face_normal(centring, axis) ? Reflected{-here, -1} : Reflected{-here - 1, 1};
}

// Points of the whole, ghosts too, from those of the part.
inline void unfold(const Grid& part, Centring centring, ConstView from, View to) {
  const auto at = [&](int axis, int index) { return reflected(part, centring, axis, index); };
  for (int k = -1; k <= to.extent[2]; ++k) {
    for (int j = -1; j <= to.extent[1]; ++j) {
      for (int i = -1; i <= to.extent[0]; ++i) {
        const auto [x, y, z] = std::array{at(0, i), at(1, j), at(2, k)};
        to(i, j, k) = x.sign * y.sign * z.sign * from(x.index, y.index, z.index);
      }
    }
  }
}

template <class Tag>
Field<Tag> unfolded(const Field<Tag>& part) {
  Field<Tag> whole(whole_box(part.grid()));
  unfold(part.grid(), Tag::centring, part.points(), whole.points());
  return whole;
}

inline FaceVector unfolded(const FaceVector& part) {
  return {unfolded(part.x), unfolded(part.y), unfolded(part.z)};
}

inline std::shared_ptr<Field<Cell>> unfolded(const std::shared_ptr<Field<Cell>>& part) {
  return std::make_shared<Field<Cell>>(unfolded(*part));
}

// The part of the whole box that a grid stands for; ghosts of the view are points of the whole, or its ghosts.
inline ConstView part_of(const Grid& part, Centring centring, ConstView whole_points) {
  ConstView view = whole_points;
  view.extent = point_extent(part, centring);
  const std::array<std::ptrdiff_t, 3> stride{1, view.row_stride, view.plane_stride};
  for (int axis = 0; axis < 3; ++axis) {
    if (part.mirror[axis]) view.data += part.cells[axis] * stride[axis];
  }
  return view;
}

inline ConstView without_walls(const Grid& part, Centring centring, ConstView points) {
  points.data += first_unknown(part, centring, 0) + first_unknown(part, centring, 1) * points.row_stride +
                 first_unknown(part, centring, 2) * points.plane_stride;
  points.extent = unknown_extent(part, centring);
  return points;
}

// Over all points that are not on walls or mirrors.
template <class Tag>
double difference_inside(const Field<Tag>& part, const Field<Tag>& whole) {
  const Grid& grid = part.grid();
  return max_difference(part.unknowns(),
                        without_walls(grid, Tag::centring, part_of(grid, Tag::centring, whole.points())));
}

inline double difference_inside(const FaceVector& part, const FaceVector& whole) {
  return std::max(
      {difference_inside(part.x, whole.x), difference_inside(part.y, whole.y), difference_inside(part.z, whole.z)});
}

// Over all points and ghosts.
template <class Tag>
double difference_everywhere(const Field<Tag>& part, const Field<Tag>& whole) {
  const ConstView inside = part_of(part.grid(), Tag::centring, whole.points());
  double largest = 0.0;
  for (int k = -1; k <= part.extent(2); ++k) {
    for (int j = -1; j <= part.extent(1); ++j) {
      for (int i = -1; i <= part.extent(0); ++i) {
        largest = std::max(largest, std::abs(part(i, j, k) - inside(i, j, k)));
      }
    }
  }
  return largest;
}

inline double difference_everywhere(const FaceVector& part, const FaceVector& whole) {
  return std::max({difference_everywhere(part.x, whole.x), difference_everywhere(part.y, whole.y),
                   difference_everywhere(part.z, whole.z)});
}

// Functions of position with the symmetries of a grid's mirrors; elsewhere without any.
class SymmetricFunctions {
 public:
  explicit SymmetricFunctions(const Grid& part) : part_(part), whole_(whole_box(part)) {}

  double even(const Vector3& r, double phase = 0.4) const {
    double value = 1.0;
    for (int axis = 0; axis < 3; ++axis) value *= even(r, axis, phase);
    return value;
  }
  // Components that are odd along their own axis, and no flux through the walls.
  Vector3 vector(const Vector3& r, double phase = 0.4) const {
    Vector3 value{};
    for (int c = 0; c < 3; ++c) {
      const double from_wall = part_.mirror[c] ? r[c] : r[c] - whole_.lower[c];
      const double length = part_.mirror[c] ? part_.length(c) : whole_.length(c);
      value[c] = std::sin(std::numbers::pi * from_wall / length);
      for (int axis = 0; axis < 3; ++axis) {
        if (axis != c) value[c] *= even(r, axis, phase + c);
      }
    }
    return value;
  }
  // With flow through the walls, and zero net flux on every grid.
  Vector3 wall_velocity(const Vector3& r, double time) const {
    const Vector3 tangential = vector(r);
    const double swing = 1.0 + 0.5 * std::sin(3.0 * time);
    return {0.5 * r[0] + swing * tangential[0], 0.25 * r[1] + swing * tangential[1],
            -0.75 * r[2] + swing * tangential[2]};
  }

 private:
  double even(const Vector3& r, int axis, double phase) const {
    return std::cos((1.1 + 0.3 * axis) * r[axis] + (part_.mirror[axis] ? 0.0 : phase)) + 0.2;
  }

  Grid part_, whole_;
};

// Between 1 and the ratio.
inline std::shared_ptr<Field<Cell>> symmetric_viscosity(const Grid& part, double ratio) {
  const SymmetricFunctions functions(part);
  return sample_viscosity(
      part, [&](const Vector3& r) { return std::pow(ratio, 0.5 * (1.0 + std::sin(4.0 * functions.even(r)))); });
}

}  // namespace vesiflow::fluid::test
