// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/grid_band.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "transfer/roomy.h"
#include "transfer/shares.h"

namespace vesiflow::coupling {
namespace {

/// From here, in spacings, one step more of Newton's method is exact to 1e-4 of a spacing.
constexpr double close_to_foot = 0.02;

/// Within which distance a point has a node if its foot is within `distance`. The node nearest to a foot is no further
/// from it than half a diagonal of the mesh, 0.71 spacings; where the surface bends away from the point with the
/// curvature kappa that counts sqrt(1 + kappa distance) times. Room for kappa distance = 2.
double distance_of_node(double distance, double spacing) {
  return std::hypot(distance, 0.71 * std::sqrt(3.0) * spacing);
}

}  // namespace

GridBand::GridBand(const fluid::Grid& grid, fluid::Centring centring, const std::array<bool, 3>& across)
    : is_mirrored_(grid.mirror), box_(grid, centring) {
  for (int axis = 0; axis < 3; ++axis) {
    period_[axis] = grid.periodic[axis] ? grid.cells[axis] : 0;
    is_across_[axis] = grid.mirror[axis] && across[axis];
    is_odd_[axis] = grid.mirror[axis] && fluid::is_face_normal(centring, axis);
  }
}

std::size_t GridBand::count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(points(), [](const Point& point) { return point.distance() != far; }));
}

void GridBand::update(const FineSurface& surface, double width, const vesicle::VectorField* readers) {
  frame(surface, width, readers);
  const double corner = 0.5 * read_points * std::hypot(box_.spacing[0], box_.spacing[1], box_.spacing[2]);
  const double farthest = readers != nullptr ? std::max(width, corner) : width;
  nearest_.search(surface, box_, distance_of_node(farthest, surface.spacing()));
  list_candidates(distance_of_node(width, surface.spacing()), readers);
  project(surface, width);
}

void GridBand::evaluate(const FineSurface& surface, int record) {
  reads_past_others_ = false;
  in_shares(static_cast<Eigen::Index>(points_.size()), [&](Eigen::Index begin, Eigen::Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Point& point = points_[i];
      const double d = point.distance();
      if (d == far) continue;
      const FineSurface::Four g = surface.value(point.foot.place, record);
      double jump = g[0] + d * (g[1] + 0.5 * d * (g[2] + d / 3.0 * g[3]));
      // Of two feet of a point far inside, one on each side of the plane, one has been found.
      if (is_on_odd_plane(point.index)) jump = 0.0;
      const auto at = static_cast<std::size_t>(point.at);
      jump_[at] = jump;
      to_mean_[at] = std::copysign(0.5, -d) * jump;
    }
  });
}

// Those of the other box that may reach into this one.
GridBand::Images GridBand::images(int axis, const GridBand& other) const {
  if (is_mirrored_[axis]) return {{0, false}, other.is_across_[axis] ? 1 : 2, !other.is_across_[axis]};
  const int period = period_[axis];
  if (period == 0) return {{0, false}, 1, false};
  const int above = box_.last(axis) - other.box_.first[axis], below = box_.first[axis] - other.box_.last(axis);
  const auto floor_of = [](int a, int b) { return a / b - (a % b < 0 ? 1 : 0); };
  const int first = -floor_of(-below, period);
  return {{period * first, false}, std::max(0, floor_of(above, period) - first + 1), false};
}

GridBand::Image GridBand::image(int axis, const Images& all, int number) const {
  if (all.have_mirrored && number == 1) return {is_odd_[axis] ? 0 : -1, true};
  return {all.first.shift + number * period_[axis], false};
}

void GridBand::read_past(const GridBand& other) {
  const std::array<Images, 3> all{images(0, other), images(1, other), images(2, other)};
  const auto reaches_here = [&](int axis, const Image& image) {
    const auto [low, high] = std::minmax({image.of(other.box_.first[axis]), image.of(other.box_.last(axis))});
    return low <= box_.last(axis) && high >= box_.first[axis];
  };
  for (int c = 0; c < all[2].count; ++c)
    for (int b = 0; b < all[1].count; ++b)
      for (int a = 0; a < all[0].count; ++a) {
        const std::array<Image, 3> along{image(0, all[0], a), image(1, all[1], b), image(2, all[2], c)};
        // A surface is no neighbour of itself, but its images are.
        if (&other == this && std::ranges::all_of(along, [](const Image& i) { return !i.is_mirrored && i.shift == 0; }))
          continue;
        if (!(reaches_here(0, along[0]) && reaches_here(1, along[1]) && reaches_here(2, along[2]))) continue;
        double sign = 1.0;
        for (int axis = 0; axis < 3; ++axis)
          if (along[axis].is_mirrored && is_odd_[axis]) sign = -sign;
        for (const Point& point : other.points_) {
          if (!(point.distance() < 0.0)) continue;
          const int i = along[0].of(point.index[0]), j = along[1].of(point.index[1]), k = along[2].of(point.index[2]);
          if (!box_.contains(i, j, k)) continue;
          if (!reads_past_others_) {
            resize_with_room(to_read_, box_.size());
            std::ranges::copy(to_mean_, to_read_.begin());
            reads_past_others_ = true;
          }
          to_read_[static_cast<std::size_t>(box_.offset(i, j, k))] += sign * other.jump(point.at);
        }
      }
}

void GridBand::frame(const FineSurface& surface, double width, const vesicle::VectorField* readers) {
  for (int axis = 0; axis < 3; ++axis) {
    double lower = surface.lower()[axis] - width, upper = surface.upper()[axis] + width;
    if (readers != nullptr) {
      const double half = 0.5 * read_points * box_.spacing[axis];
      lower = std::min(lower, readers->col(axis).minCoeff() - half);
      upper = std::max(upper, readers->col(axis).maxCoeff() + half);
    }
    box_.first[axis] = static_cast<int>(std::floor(box_.index_at(axis, lower))) - 1;
    if (is_across_[axis]) box_.first[axis] = std::max(box_.first[axis], -layers_beyond);
    const int last = static_cast<int>(std::ceil(box_.index_at(axis, upper))) + 1;
    box_.extent[axis] = std::max(last - box_.first[axis] + 1, NearestNodes::smallest_row);
    std::vector<int>& in_grid = in_grid_[static_cast<std::size_t>(axis)];
    resize_with_room(in_grid, static_cast<std::size_t>(box_.extent[axis]));
    const int period = period_[axis];
    for (int i = 0; i < box_.extent[axis]; ++i) {
      const int index = box_.first[axis] + i;
      in_grid[static_cast<std::size_t>(i)] = period != 0                       ? ((index % period) + period) % period
                                             : is_mirrored_[axis] && index < 0 ? (is_odd_[axis] ? 0 : -1) - index
                                                                               : index;
    }
  }
  resize_with_room(distance_, box_.size());
  resize_with_room(jump_, box_.size());
  resize_with_room(to_mean_, box_.size());
  resize_with_room(limits_, box_.size());
  resize_with_room(first_of_plane_, static_cast<std::size_t>(box_.extent[2]) + 1);
}

void GridBand::list_candidates(double reach, const vesicle::VectorField* readers) {
  const auto plane = box_.stride(2);
  const NearestNodes::Key* const keys = nearest_.keys().data();
  NearestNodes::Key* const limits = limits_.data();
  first_of_plane_[0] = 0;
  in_shares(box_.extent[2], [&](Eigen::Index first, Eigen::Index end) {
    const auto fill = [&](auto& values, auto value) {
      std::fill(values.begin() + first * plane, values.begin() + end * plane, value);
    };
    fill(distance_, far);
    fill(jump_, 0.0);
    fill(to_mean_, 0.0);
    fill(limits_, nearest_.limit(reach));
    if (readers != nullptr) mark_read(*readers, static_cast<int>(first), static_cast<int>(end));
    for (Eigen::Index k = first; k < end; ++k) {
      int count = 0;
      for (Eigen::Index at = k * plane; at < (k + 1) * plane; ++at) count += keys[at] < limits[at] ? 1 : 0;
      first_of_plane_[static_cast<std::size_t>(k) + 1] = count;
    }
  });
  std::partial_sum(first_of_plane_.begin(), first_of_plane_.end(), first_of_plane_.begin());
  const auto count = static_cast<std::size_t>(first_of_plane_.back());
  // With room to grow, so that a body that moves does not allocate in every other step.
  resize_with_room(points_, count);
  in_shares(box_.extent[2], [&](Eigen::Index first, Eigen::Index end) {
    Point* next = points_.data() + first_of_plane_[static_cast<std::size_t>(first)];
    auto at = static_cast<std::int32_t>(first * plane);
    for (int k = box_.first[2] + static_cast<int>(first); k < box_.first[2] + static_cast<int>(end); ++k)
      for (int j = box_.first[1]; j <= box_.last(1); ++j)
        for (int i = box_.first[0]; i <= box_.last(0); ++i, ++at)
          if (keys[at] < limits[at]) {
            next->index = {i, j, k};
            next->at = at;
            ++next;
          }
  });
}

void GridBand::mark_read(const vesicle::VectorField& readers, int first_plane, int end_plane) {
  for (Eigen::Index m = 0; m < readers.rows(); ++m) {
    std::array<int, 3> from;
    for (int axis = 0; axis < 3; ++axis) from[axis] = reading(axis, readers(m, axis)).first - box_.first[axis];
    for (int c = std::max(from[2], first_plane); c < std::min(from[2] + read_points, end_plane); ++c)
      for (int b = from[1]; b < from[1] + read_points; ++b) {
        NearestNodes::Key* limits = limits_.data() + c * box_.stride(2) + b * box_.stride(1) + from[0];
        for (int a = 0; a < read_points; ++a) limits[a] = NearestNodes::limit();
      }
  }
}

void GridBand::project(const FineSurface& surface, double width) {
  const double close = close_to_foot * *std::min_element(box_.spacing.begin(), box_.spacing.end());
  const auto project_some = [&](std::span<Point> points) {
    std::array<FootQuery, feet_at_a_time> queries;
    std::array<Foot, feet_at_a_time> feet;
    for (std::size_t i = 0; i < points.size(); ++i)
      queries[i] = {position(points[i].index), nearest_.node(points[i].at)};
    find_feet(surface, {queries.data(), points.size()}, close, feet);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto at = static_cast<std::size_t>(points[i].at);
      const bool is_read = limits_[at] == NearestNodes::limit();
      points[i].foot = feet[i];
      if (!is_read && !(std::abs(feet[i].distance) <= width)) points[i].foot.distance = far;
      distance_[at] = points[i].distance();
    }
  };
  // The same points are looked for together for any number of threads.
  const std::size_t blocks = (points_.size() + feet_at_a_time - 1) / feet_at_a_time;
  in_shares(static_cast<Eigen::Index>(blocks), [&](Eigen::Index begin, Eigen::Index end) {
    for (auto block = static_cast<std::size_t>(begin); block < static_cast<std::size_t>(end); ++block) {
      const std::size_t first = block * feet_at_a_time;
      const std::size_t count = std::min<std::size_t>(feet_at_a_time, points_.size() - first);
      project_some(std::span<Point>(points_).subspan(first, count));
    }
  });
}

}  // namespace vesiflow::coupling
