// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/body_phases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "transfer/roomy.h"
#include "viscosity/copy_field.h"
#include "viscosity/grid_places.h"

namespace vesiflow::coupling {
namespace {

constexpr std::array<std::size_t, 3> axes{0, 1, 2};
constexpr std::size_t numbers_at_first = 12;

/// Points that a box which must grow gets more than it needs, so that a body that moves and turns hardly ever allocates.
constexpr int room = 4;

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

void add(const fluid::FaceVector& more, fluid::FaceVector& to) {
  const auto add_field = [](const auto& from, auto& sum) {
    std::transform(from.data(), from.data() + from.size(), sum.data(), sum.data(), std::plus<>());
  };
  add_field(more.x, to.x);
  add_field(more.y, to.y);
  add_field(more.z, to.z);
}

}  // namespace

BodyPhases::Phase::Phase(const fluid::Grid& grid, bool convects) : velocity(grid) {
  if (convects) convection.emplace(grid);
}

// The outermost points have no neighbours on all sides.
BodyPhases::Points BodyPhases::points_of(const Times& of) const {
  Points common{};
  if (boxes_.empty()) return common;
  for (const std::size_t axis : axes) {
    const auto begin = [&](std::size_t back) { return boxes_[of[back]].known[axis]; };
    const auto end = [&](std::size_t back) { return begin(back) + boxes_[of[back]].extent[axis]; };
    common.first[axis] = std::max({begin(0), begin(1), begin(2)}) + 1;
    common.extent[axis] = std::max(0, std::min({end(0), end(1), end(2)}) - 1 - common.first[axis]);
  }
  return common;
}

BodyPhases::AllLevels BodyPhases::levels(std::size_t component, const Times& of) const {
  const Points common = points_of(of);
  const auto at_first = [&](std::size_t time, const fluid::FaceVector& field) {
    const fluid::ConstView view = field.points()[component];
    const std::array<int, 3>& first = boxes_[time].first;
    return view.row(common.first[1] - first[1], common.first[2] - first[2]) + (common.first[0] - first[0]);
  };
  const auto of_phase = [&](Phase Box::*phase) {
    const auto velocity = [&](std::size_t back) { return at_first(of[back], (boxes_[of[back]].*phase).velocity); };
    const auto convection = [&](std::size_t back) {
      const Phase& then = boxes_[of[back]].*phase;
      return at_first(of[back], then.convection ? *then.convection : then.velocity);
    };
    return Levels{velocity(0), velocity(1), velocity(2), convection(0), convection(1)};
  };
  const fluid::ConstView view = boxes_[of[0]].whole.velocity.points()[component];
  return {of_phase(&Box::whole), of_phase(&Box::outer), of_phase(&Box::inner), view.row_stride, view.plane_stride};
}

// The boxes of all times are alike, as a run that is restarted knows no more than their size: convection has bits of the
// grid of its box.
void BodyPhases::resize(const std::array<int, 3>& points) {
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
    to.known = from.known;
    to.extent = from.extent;
    for (const auto phase : {&Box::whole, &Box::outer, &Box::inner}) {
      const auto sources = (from.*phase).velocity.points();
      const auto targets = (to.*phase).velocity.points();
      for (std::size_t c = 0; c < 3; ++c)
        for (int k = 0; k < points_[2]; ++k)
          for (int j = 0; j < points_[1]; ++j)
            std::copy_n(sources[c].row(j, k), points_[0], targets[c].row(j + shift[1], k + shift[2]) + shift[0]);
    }
    convect(to);
  }
  boxes_ = std::move(boxes);
  points_ = points;
  for (const std::size_t axis : axes) reserve_with_room(held_[axis], static_cast<std::size_t>(points[axis]) + 3);
}

// So that it has the bands of the body. Boxes stay as large as they have been.
void BodyPhases::frame(std::size_t time, const SharpTransfer& body) {
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
  Box& box = boxes_[time];
  for (const std::size_t axis : axes) box.first[axis] = first[axis] - (points_[axis] - needed[axis]) / 2;
  box.known = box.first;
  box.extent = points_;
}

BodyPhases::Held BodyPhases::held_at(int point, std::size_t axis, std::size_t component, int extent) const {
  Held held;
  if (grid_.mirror[axis] && point < 0) {
    point = component == axis ? -point : -1 - point;
    if (component == axis) held.factor = -1.0;
  }
  const GridPlaces places(point, static_cast<int>(axis), grid_, extent);
  if (places.count > 0) held.place = *places.begin();
  return held;
}

void BodyPhases::find_held(const Box& box, std::size_t component, const fluid::ConstView& field) {
  const auto to = box.whole.velocity.points()[component];
  for (const std::size_t axis : axes) {
    held_[axis].clear();
    for (int i = -1; i <= to.extent[axis]; ++i)
      held_[axis].push_back(held_at(box.first[axis] + i, axis, component, field.extent[axis]));
  }
}

// Zero where the grid has no point.
void BodyPhases::copy_from(const fluid::ConstView& field, const fluid::View& to) const {
  const auto& [along_x, along_y, along_z] = held_;
  const std::size_t count = along_x.size();
  bool is_run = true;
  for (std::size_t i = 0; i < count; ++i)
    is_run = is_run && along_x[i].place == along_x[0].place + static_cast<int>(i) && along_x[i].factor == 1.0;
  is_run = is_run && along_x[0].place != Held::nowhere;
  for (std::size_t k = 0; k < along_z.size(); ++k)
    for (std::size_t j = 0; j < along_y.size(); ++j) {
      const Held &y = along_y[j], &z = along_z[k];
      double* const row = to.row(static_cast<int>(j) - 1, static_cast<int>(k) - 1) - 1;
      if (std::min(y.place, z.place) == Held::nowhere) {
        std::fill_n(row, count, 0.0);
        continue;
      }
      const double* const from = field.row(y.place, z.place);
      const double factor = y.factor * z.factor;
      if (is_run && factor == 1.0) {
        std::copy_n(from + along_x[0].place, count, row);
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        row[i] = along_x[i].place == Held::nowhere ? 0.0 : along_x[i].factor * factor * from[along_x[i].place];
    }
}

// Beyond the membrane that of the outer phase less the jump.
void BodyPhases::continue_inner(Box& box, std::size_t component, const GridBand& band) const {
  const fluid::View inner = box.inner.velocity.points()[component];
  const fluid::ConstView outer = std::as_const(box).outer.velocity.points()[component];
  for (const GridBand::Point& point : band.points()) {
    if (point.distance() == GridBand::far || band.is_inside(point.at)) continue;
    const int i = point.index[0] - box.first[0], j = point.index[1] - box.first[1], k = point.index[2] - box.first[2];
    const auto is_nowhere = [this](std::size_t axis, int at) {
      return held_[axis][static_cast<std::size_t>(at + 1)].place == Held::nowhere;
    };
    if (is_nowhere(0, i) || is_nowhere(1, j) || is_nowhere(2, k)) continue;
    inner(i, j, k) = outer(i, j, k) - band.jump(point.at);
  }
}

void BodyPhases::convect(Box& box) {
  for (Phase* phase : {&box.whole, &box.outer, &box.inner})
    if (phase->convection) fluid::convection(phase->velocity, *phase->convection);
}

void BodyPhases::begin(const SharpTransfer& body, double ratio, const fluid::FaceVector& velocity) {
  const auto fields = velocity.points();
  for (std::size_t time = 0; time < times; ++time) {
    frame(time, body);
    Box& box = boxes_[time];
    for (const std::size_t c : axes) {
      find_held(box, c, fields[c]);
      copy_from(fields[c], box.whole.velocity.points()[c]);
    }
    copy_field(box.whole.velocity, box.outer.velocity);
    copy_field(box.whole.velocity, box.inner.velocity);
    for_storage(box.inner.velocity, [ratio](double* w, std::size_t count) {
      std::transform(w, w + count, w, [ratio](double u) { return ratio * u; });
    });
    convect(box);
  }
}

void BodyPhases::keep(std::size_t time, const SharpTransfer& body, const fluid::FaceVector& velocity,
                      const fluid::FaceVector& continuation) {
  frame(time, body);
  Box& box = boxes_[time];
  const auto fields = velocity.points(), continuations = continuation.points();
  const auto whole = box.whole.velocity.points(), outer = box.outer.velocity.points();
  for (const std::size_t c : axes) {
    find_held(box, c, fields[c]);
    copy_from(fields[c], whole[c]);
    copy_from(continuations[c], outer[c]);
  }
  add(box.whole.velocity, box.outer.velocity);
  copy_field(box.whole.velocity, box.inner.velocity);
  for (const std::size_t c : axes) {
    find_held(box, c, fields[c]);
    continue_inner(box, c, body.band(static_cast<int>(c)));
  }
  convect(box);
}

void BodyPhases::put_outer(std::size_t time, fluid::FaceVector& velocity) const {
  const Box& box = boxes_[time];
  const auto from = box.outer.velocity.points();
  const auto to = velocity.points();
  for (const std::size_t c : axes)
    for (int k = 0; k < from[c].extent[2]; ++k)
      for (int j = 0; j < from[c].extent[1]; ++j)
        for (int i = 0; i < from[c].extent[0]; ++i)
          for_places({box.first[0] + i, box.first[1] + j, box.first[2] + k}, grid_, to[c].extent,
                     [&](int x, int y, int z) { to[c](x, y, z) = from[c](i, j, k); });
}

std::vector<double> BodyPhases::state(std::size_t time, bool has_outer) const {
  const Box& box = boxes_.at(time);
  std::vector<double> row;
  row.reserve(numbers_at_first + (has_outer ? 2 : 1) * storage(box.inner.velocity));
  for (const std::array<int, 3>* numbers : {&box.first, &points_, &box.known, &box.extent})
    row.insert(row.end(), numbers->begin(), numbers->end());
  const auto append = [&row](const double* values, std::size_t count) {
    row.insert(row.end(), values, values + count);
  };
  for_storage(box.inner.velocity, append);
  if (has_outer) for_storage(box.outer.velocity, append);
  return row;
}

void BodyPhases::restore(std::span<const Saved> saved) {
  const std::span<const double> row = saved.front().inner;
  const auto refuse = [&] {
    throw std::invalid_argument(
        fmt::format("the velocity inside a vesicle, of which the latest has {} numbers, is not of boxes of one size "
                    "with finite values",
                    row.size()));
  };
  const auto whole_number = [&](double value, double least, double most) {
    if (!(value >= least && value <= most) || value != std::floor(value)) refuse();
    return static_cast<int>(value);
  };
  std::array<int, 3> points{};
  double count = 1.0;
  for (const Saved& one : saved) {
    const std::span<const double> each = one.inner;
    if (each.size() < numbers_at_first) refuse();
    if (!std::ranges::all_of(each, [](double x) { return std::isfinite(x); })) refuse();
    for (const std::size_t axis : axes) {
      const int first = whole_number(each[axis], -1e9, 1e9);
      if (each[3 + axis] != row[3 + axis]) refuse();
      const int known = whole_number(each[6 + axis], first, std::min(first + each[3 + axis], 1e9));
      whole_number(each[9 + axis], 0, std::min(first + each[3 + axis] - known, 1e9));
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
  for (const Saved& one : saved) {
    Box& box = boxes_[one.time];
    const std::size_t phases = one.outer == nullptr ? 2 : 1;
    if (one.inner.size() != numbers_at_first + phases * storage(box.inner.velocity)) refuse();
    for (const std::size_t axis : axes) {
      box.first[axis] = static_cast<int>(one.inner[axis]);
      box.known[axis] = static_cast<int>(one.inner[6 + axis]);
      box.extent[axis] = static_cast<int>(one.inner[9 + axis]);
    }
    const double* next = one.inner.data() + numbers_at_first;
    const auto take = [&next](double* values, std::size_t size) {
      std::copy_n(next, size, values);
      next += size;
    };
    for_storage(box.inner.velocity, take);
    if (one.outer == nullptr) {
      for_storage(box.outer.velocity, take);
      continue;
    }
    const auto fields = one.velocity->points(), outer_fields = one.outer->points();
    for (const std::size_t c : axes) {
      find_held(box, c, fields[c]);
      copy_from(fields[c], box.whole.velocity.points()[c]);
      copy_from(outer_fields[c], box.outer.velocity.points()[c]);
    }
    convect(box);
  }
}

}  // namespace vesiflow::coupling
