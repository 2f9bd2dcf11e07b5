// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/grid_band.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "transfer/shares.h"

namespace vesiflow::coupling {
namespace {

/// From here, in spacings, one step more of Newton's method is exact to 1e-4 of a spacing.
constexpr double close_to_foot = 0.02;

}  // namespace

GridBand::GridBand(const fluid::Grid& grid, fluid::Centring centring) : box_(grid, centring) {
  for (int axis = 0; axis < 3; ++axis) period_[axis] = grid.periodic[axis] ? grid.cells[axis] : 0;
}

std::size_t GridBand::count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(points(), [](const Point& point) { return point.distance() != far; }));
}

void GridBand::update(const FineSurface& surface, double width, const vesicle::VectorField* readers) {
  frame(surface, width, readers);
  // The node nearest to a point is no more than 0.7 spacings from its foot, and less than one further where the surface
  // bends away from the point.
  const auto to_node = [&](double distance) { return std::hypot(distance, surface.spacing()); };
  const double corner = 0.5 * read_points * std::hypot(box_.spacing[0], box_.spacing[1], box_.spacing[2]);
  nearest_.search(surface, box_, to_node(readers != nullptr ? std::max(width, corner) : width));
  list_candidates(to_node(width), readers);
  project(surface, width);
}

void GridBand::evaluate(const FineSurface& surface, int record) {
  in_shares(static_cast<Eigen::Index>(points_.size()), [&](Eigen::Index begin, Eigen::Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Point& point = points_[i];
      const double d = point.distance();
      if (d == far) continue;
      const FineSurface::Four g = surface.value(point.foot.place, record);
      const double jump = g[0] + d * (g[1] + 0.5 * d * (g[2] + d / 3.0 * g[3]));
      const auto at = static_cast<std::size_t>(point.at);
      jump_[at] = jump;
      to_mean_[at] = std::copysign(0.5, -d) * jump;
    }
  });
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
    const int last = static_cast<int>(std::ceil(box_.index_at(axis, upper))) + 1;
    box_.extent[axis] = std::max(last - box_.first[axis] + 1, NearestNodes::smallest_row);
    std::vector<int>& in_grid = in_grid_[static_cast<std::size_t>(axis)];
    in_grid.clear();
    for (int index = box_.first[axis]; index <= box_.last(axis); ++index) {
      const int period = period_[axis];
      in_grid.push_back(period == 0 ? index : ((index % period) + period) % period);
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
      for (Eigen::Index at = k * plane; at < (k + 1) * plane; ++at) count += is_candidate(at) ? 1 : 0;
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
          if (is_candidate(at)) {
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
      for (int b = from[1]; b < from[1] + read_points; ++b)
        std::fill_n(limits_.begin() + c * box_.stride(2) + b * box_.stride(1) + from[0], read_points, nearest_.limit());
  }
}

void GridBand::project(const FineSurface& surface, double width) {
  const double close = close_to_foot * *std::min_element(box_.spacing.begin(), box_.spacing.end());
  in_shares(static_cast<Eigen::Index>(points_.size()), [&](Eigen::Index share_begin, Eigen::Index share_end) {
    constexpr Eigen::Index most = 64;
    std::array<FootQuery, most> queries;
    std::array<Foot, most> feet;
    for (Eigen::Index begin = share_begin; begin < share_end; begin += most) {
      const auto count = static_cast<std::size_t>(std::min(most, share_end - begin));
      const std::span<Point> points(points_.data() + begin, count);
      for (std::size_t i = 0; i < count; ++i) queries[i] = {position(points[i].index), nearest_.node(points[i].at)};
      find_feet(surface, {queries.data(), count}, close, {feet.data(), count});
      for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(points[i].at);
        const bool is_read = limits_[at] == nearest_.limit();
        points[i].foot = feet[i];
        if (!is_read && !(std::abs(feet[i].distance) <= width)) points[i].foot.distance = far;
        distance_[at] = points[i].distance();
      }
    }
  });
}

}  // namespace vesiflow::coupling
