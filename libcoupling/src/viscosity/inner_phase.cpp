// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/inner_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "viscosity/grid_places.h"

namespace vesiflow::coupling {
namespace {

constexpr std::array<std::size_t, 3> axes{0, 1, 2};
constexpr std::size_t numbers_at_first = 6;

/// Points that a box which must grow gets more than it needs, so that a body that moves and turns hardly ever allocates.
constexpr int room = 4;

/// What no field holds: ghosts are at -1.
constexpr int nowhere = -2;

/// Where along an axis a field of the grid holds a point, and the factor of its value: beyond a mirror plane that of its
/// image, for the component normal to the plane with the other sign.
struct Held {
  int place = nowhere;
  double factor = 1.0;
};

Held held_at(int point, std::size_t axis, std::size_t component, const fluid::Grid& grid, int extent) {
  Held held;
  if (grid.mirror[axis] && point < 0) {
    point = component == axis ? -point : -1 - point;
    if (component == axis) held.factor = -1.0;
  }
  const GridPlaces places(point, static_cast<int>(axis), grid, extent);
  if (places.count > 0) held.place = *places.begin();
  return held;
}

std::size_t storage(const fluid::FaceVector& field) {
  return field.x.size() + field.y.size() + field.z.size();
}

/// visit(numbers, count) for the components with their ghosts.
template <class Field, class Visit>
void for_storage(Field& field, const Visit& visit) {
  visit(field.x.data(), field.x.size());
  visit(field.y.data(), field.y.size());
  visit(field.z.data(), field.z.size());
}

}  // namespace

InnerPhase::Box::Box(const fluid::Grid& grid, bool convects) : velocity(grid) {
  if (convects) convection.emplace(grid);
}

bool InnerPhase::has(std::size_t time, const std::array<int, 3>& point) const {
  if (boxes_.empty()) return false;
  const Box& box = boxes_[time];
  return std::ranges::all_of(axes, [&](std::size_t axis) {
    return point[axis] >= box.first[axis] && point[axis] < box.first[axis] + points_[axis];
  });
}

InnerPhase::Value InnerPhase::at(std::size_t time, int component, const std::array<int, 3>& point) const {
  const Box& box = boxes_[time];
  const int i = point[0] - box.first[0], j = point[1] - box.first[1], k = point[2] - box.first[2];
  const auto value = [&](const fluid::FaceVector& field) {
    return component == 0 ? field.x(i, j, k) : component == 1 ? field.y(i, j, k) : field.z(i, j, k);
  };
  return {value(box.velocity), box.convection ? value(*box.convection) : 0.0};
}

// The boxes of all times are alike, as a run that is restarted knows no more than their size: convection has bits of the
// grid of its box.
void InnerPhase::resize(const std::array<int, 3>& points) {
  fluid::Vector3 upper{};
  for (const std::size_t axis : axes) upper[axis] = points[axis] * grid_.spacing(static_cast<int>(axis));
  const fluid::Grid grid({0.0, 0.0, 0.0}, upper, points);
  std::vector<Box> boxes;
  for (std::size_t time = 0; time < times; ++time) boxes.emplace_back(grid, convects_);
  for (std::size_t time = 0; time < boxes_.size(); ++time) {
    const Box& from = boxes_[time];
    Box& to = boxes[time];
    std::array<int, 3> shift{};
    for (const std::size_t axis : axes) {
      shift[axis] = (points[axis] - points_[axis]) / 2;
      to.first[axis] = from.first[axis] - shift[axis];
    }
    const auto sources = from.velocity.points();
    const auto targets = to.velocity.points();
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < points_[2]; ++k)
        for (int j = 0; j < points_[1]; ++j)
          std::copy_n(sources[c].row(j, k), points_[0], targets[c].row(j + shift[1], k + shift[2]) + shift[0]);
    convect(to);
  }
  boxes_ = std::move(boxes);
  points_ = points;
}

// So that it has the bands of the body. Boxes stay as large as they have been.
void InnerPhase::frame(std::size_t time, const SharpTransfer& body) {
  std::array<int, 3> first{}, needed{}, points = points_;
  for (const std::size_t axis : axes) {
    int low = body.band(0).first()[axis], end = low;
    for (const int c : {0, 1, 2}) {
      const GridBand& band = body.band(c);
      low = std::min(low, band.first()[axis]);
      end = std::max(end, band.first()[axis] + band.extent()[axis]);
    }
    first[axis] = low;
    needed[axis] = end - low;
    if (needed[axis] > points[axis]) points[axis] = needed[axis] + room;
  }
  if (points != points_) resize(points);
  for (const std::size_t axis : axes) boxes_[time].first[axis] = first[axis] - (points_[axis] - needed[axis]) / 2;
}

// Zero where the grid has no point.
void InnerPhase::copy_from(const fluid::FaceVector& whole, Box& box) const {
  const auto targets = box.velocity.points();
  const auto sources = whole.points();
  for (std::size_t c = 0; c < 3; ++c) {
    const fluid::View target = targets[c];
    const fluid::ConstView source = sources[c];
    const auto held = [&](std::size_t axis, int point) {
      return held_at(box.first[axis] + point, axis, c, grid_, source.extent[axis]);
    };
    for (int k = -1; k <= target.extent[2]; ++k) {
      const Held z = held(2, k);
      for (int j = -1; j <= target.extent[1]; ++j) {
        const Held y = held(1, j);
        double* row = target.row(j, k);
        for (int i = -1; i <= target.extent[0]; ++i) {
          const Held x = held(0, i);
          row[i] = std::min({x.place, y.place, z.place}) == nowhere
                       ? 0.0
                       : x.factor * y.factor * z.factor * source(x.place, y.place, z.place);
        }
      }
    }
  }
}

void InnerPhase::convect(Box& box) {
  if (box.convection) fluid::convection(box.velocity, *box.convection);
}

void InnerPhase::begin(const SharpTransfer& body, double ratio, const fluid::FaceVector& velocity) {
  for (std::size_t time = 0; time < times; ++time) {
    frame(time, body);
    copy_from(velocity, boxes_[time]);
    for_storage(boxes_[time].velocity, [ratio](double* w, std::size_t count) {
      std::transform(w, w + count, w, [ratio](double u) { return ratio * u; });
    });
    convect(boxes_[time]);
  }
}

void InnerPhase::keep(std::size_t time, const SharpTransfer& body, const fluid::FaceVector& velocity,
                      const fluid::FaceVector& outer) {
  frame(time, body);
  Box& box = boxes_[time];
  copy_from(velocity, box);
  const auto targets = box.velocity.points();
  const auto sources = outer.points();
  for (const int c : {0, 1, 2}) {
    const GridBand& band = body.band(c);
    const fluid::View target = targets[static_cast<std::size_t>(c)];
    const fluid::ConstView source = sources[static_cast<std::size_t>(c)];
    for (const GridBand::Point& point : band.points()) {
      if (point.distance() == GridBand::far || band.is_inside(point.at)) continue;
      std::array<int, 3> place{};
      double factor = 1.0;
      for (const std::size_t axis : axes) {
        const Held held = held_at(point.index[axis], axis, static_cast<std::size_t>(c), grid_, source.extent[axis]);
        place[axis] = held.place;
        factor *= held.factor;
      }
      if (std::ranges::find(place, nowhere) != place.end()) continue;
      target(point.index[0] - box.first[0], point.index[1] - box.first[1], point.index[2] - box.first[2]) =
          factor * source(place[0], place[1], place[2]) - band.jump(point.at);
    }
  }
  convect(box);
}

std::vector<double> InnerPhase::state(std::size_t time) const {
  const Box& box = boxes_.at(time);
  std::vector<double> row;
  row.reserve(numbers_at_first + storage(box.velocity));
  row.insert(row.end(), box.first.begin(), box.first.end());
  row.insert(row.end(), points_.begin(), points_.end());
  for_storage(box.velocity,
              [&row](const double* values, std::size_t count) { row.insert(row.end(), values, values + count); });
  return row;
}

void InnerPhase::restore(std::size_t now, std::span<const double> row, std::size_t before,
                         std::span<const double> earlier) {
  const auto refuse = [&] {
    throw std::invalid_argument(
        fmt::format("the velocity inside a vesicle is two rows of {} and {} numbers, which are no boxes of one size "
                    "with finite values",
                    row.size(), earlier.size()));
  };
  const auto whole_number = [&](double value, double least, double most) {
    if (!(value >= least && value <= most) || value != std::floor(value)) refuse();
    return static_cast<int>(value);
  };
  std::array<int, 3> points{};
  double count = 1.0;
  for (const std::span<const double> each : {row, earlier}) {
    if (each.size() != row.size() || each.size() < numbers_at_first) refuse();
    if (!std::ranges::all_of(each, [](double x) { return std::isfinite(x); })) refuse();
    for (const std::size_t axis : axes) {
      whole_number(each[axis], -1e9, 1e9);
      if (each[3 + axis] != row[3 + axis]) refuse();
    }
  }
  for (const std::size_t axis : axes) {
    points[axis] = whole_number(row[3 + axis], fluid::Grid::min_cells, fluid::Grid::max_cells);
    count *= points[axis];
  }
  if (3.0 * count > static_cast<double>(row.size())) refuse();  // before it takes memory
  if (points != points_) {
    boxes_.clear();
    resize(points);
  }
  if (row.size() != numbers_at_first + storage(boxes_[now].velocity)) refuse();
  for (const auto& [time, from] : {std::pair{now, row}, std::pair{before, earlier}}) {
    Box& box = boxes_[time];
    for (const std::size_t axis : axes) box.first[axis] = static_cast<int>(from[axis]);
    const double* next = from.data() + numbers_at_first;
    for_storage(box.velocity, [&next](double* values, std::size_t size) {
      std::copy_n(next, size, values);
      next += size;
    });
    convect(box);
  }
}

}  // namespace vesiflow::coupling
