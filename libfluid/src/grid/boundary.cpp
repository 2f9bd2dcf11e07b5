// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "grid/check_grid.h"
#include "grid/planes.h"
#include "message.h"

namespace vesiflow::fluid {
namespace {

// The two axes along a wall, in increasing order.
constexpr std::array<std::array<int, 2>, 3> wall_axes{{{1, 2}, {0, 2}, {0, 1}}};

// Ghosts across an axis whose points repeat after a number of cells.
void repeat_into_ghosts(const View& field, int axis, int period) {
  const auto [axis_a, axis_b] = wall_axes[axis];
  const std::ptrdiff_t step = stride(field, axis);
  const int count = field.extent[axis];
  const int from_a = axis_a < axis ? -1 : 0;
  const int from_b = axis_b < axis ? -1 : 0;
  for (int b = from_b; b < field.extent[axis_b] - from_b; ++b) {
    for (int a = from_a; a < field.extent[axis_a] - from_a; ++a) {
      double* line = field.data + a * stride(field, axis_a) + b * stride(field, axis_b);
      line[-step] = line[(period - 1) * step];
      line[count * step] = line[(count - period) * step];
    }
  }
}

// Ghosts below the mirror of an axis, of a component along that axis or of one that is even.
void reflect_into_ghosts(const View& field, int axis, bool normal) {
  const auto [axis_a, axis_b] = wall_axes[axis];
  const std::ptrdiff_t step = stride(field, axis);
  const int from_a = axis_a < axis ? -1 : 0;
  const int from_b = axis_b < axis ? -1 : 0;
  for (int b = from_b; b < field.extent[axis_b] - from_b; ++b) {
    for (int a = from_a; a < field.extent[axis_a] - from_a; ++a) {
      double* line = field.data + a * stride(field, axis_a) + b * stride(field, axis_b);
      line[-step] = normal ? -line[step] : line[0];
    }
  }
}

}  // namespace

WallVelocity::WallVelocity(const Grid& grid, BoundaryVelocity velocity, WallMotion motion)
    : grid_(grid), velocity_(std::move(velocity)), motion_(motion) {
  if (!velocity_ && grid.has_walls()) {
    throw std::invalid_argument("boundary: the velocity of the walls is an empty function");
  }
  for (int component = 0; component < 3; ++component) {
    const auto extent = point_extent(grid, face_centrings[component]);
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<int, 2> along{extent[wall_axes[axis][0]], extent[wall_axes[axis][1]]};
      const std::size_t size = static_cast<std::size_t>(along[0] + 2) * (along[1] + 2);
      for (int side = 0; side < 2; ++side) {
        planes_.push_back({component, axis, side, along, std::vector<double>(grid.has_wall(axis, side) ? size : 0)});
      }
    }
  }
  if (!steady()) spare_planes_ = planes_;
  sample_all();
}

void WallVelocity::evaluate(double time) {
  if (steady() || time == time_) return;
  const double time_before = std::exchange(time_, time);
  const double flux_before = net_flux_;
  std::swap(planes_, spare_planes_);
  try {
    sample_all();
  } catch (...) {
    std::swap(planes_, spare_planes_);
    time_ = time_before;
    net_flux_ = flux_before;
    throw;
  }
}

// What the function of the walls deviates by from what mirrors and periodic axes ask for, at most.
struct WallVelocity::Deviations {
  struct OnMirror {
    double value = 0.0;
    int component = 0;
    Vector3 position{};
  } on_mirror;
  struct OverPeriod {
    double at_low = 0.0, at_high = 0.0;
    int component = 0, axis = 0;
  } over_period;
  double greatest = 0.0;  // |velocity component|, for comparison
};

void WallVelocity::sample_all() {
  Deviations found;
  for (Plane& plane : planes_) {
    if (!grid_.has_wall(plane.axis, plane.side)) continue;
    if (plane.component == plane.axis) compare_periods(plane, found);
    sample(plane, found);
  }
  refuse(found);
  balance_flux();
}

double WallVelocity::sampled_at(const Vector3& position, int component, Deviations& found) const {
  const double value = velocity_(position, time_)[component];
  found.greatest = std::max(found.greatest, std::abs(value));
  if (std::isfinite(value)) return value;
  throw std::invalid_argument(message("boundary: velocity component ", component, " is ", value, " at (", position[0],
                                      ", ", position[1], ", ", position[2], "), time ", time_));
}

// Round-off of the greatest velocity at the walls, or of 1: where walls are at rest, a function gives the round-off of what it knows.
void WallVelocity::refuse(const Deviations& found) const {
  const double round_off = 1e-10 * std::max(1.0, found.greatest);
  if (const auto& [value, component, position] = found.on_mirror; std::abs(value) > round_off)
    throw std::invalid_argument(message("boundary: velocity component ", component, " of the walls is ", value, " at (",
                                        position[0], ", ", position[1], ", ", position[2], "), on the mirror of axis ",
                                        component, "; it must be zero there"));
  if (const auto& [at_low, at_high, component, axis] = found.over_period; std::abs(at_low - at_high) > round_off)
    throw std::invalid_argument(message("boundary: velocity component ", component, " of the walls is ", at_low,
                                        " at one end of periodic axis ", axis, " and ", at_high,
                                        " at the other; it must be the same"));
}

// Compares the function at the two ends of the periodic axes along a wall.
void WallVelocity::compare_periods(const Plane& plane, Deviations& found) const {
  for (int a = 0; a < 2; ++a) {
    const int periodic_axis = wall_axes[plane.axis][a];
    if (!grid_.periodic[periodic_axis]) continue;
    const int other_axis = wall_axes[plane.axis][1 - a];
    for (int i = 0; i < grid_.cells[other_axis]; ++i) {
      Vector3 low = grid_.lower;
      if (plane.side == 1) low[plane.axis] = grid_.upper[plane.axis];
      low[other_axis] += (i + 0.5) * grid_.spacing(other_axis);
      Vector3 high = low;
      high[periodic_axis] = grid_.upper[periodic_axis];
      for (int component = 0; component < 3; ++component) {
        const double at_low = sampled_at(low, component, found), at_high = sampled_at(high, component, found);
        const auto& most = found.over_period;
        if (std::abs(at_low - at_high) > std::abs(most.at_low - most.at_high))
          found.over_period = {at_low, at_high, component, periodic_axis};
      }
    }
  }
}

void WallVelocity::sample(Plane& plane, Deviations& found) const {
  const auto [axis_a, axis_b] = wall_axes[plane.axis];
  const auto [count_a, count_b] = plane.extent;
  for (int b = 0; b < count_b; ++b) {
    for (int a = 0; a < count_a; ++a) {
      std::array<int, 3> index{};
      index[axis_a] = a;
      index[axis_b] = b;
      Vector3 position = point_position(grid_, face_centrings[plane.component], index[0], index[1], index[2]);
      position[plane.axis] = plane.side == 0 ? grid_.lower[plane.axis] : grid_.upper[plane.axis];
      plane.at(a, b) = sampled_at(position, plane.component, found);
      if (plane.component != plane.axis && grid_.mirror[plane.component] && index[plane.component] == 0) {
        if (std::abs(plane.at(a, b)) > std::abs(found.on_mirror.value))
          found.on_mirror = {plane.at(a, b), plane.component, position};
        plane.at(a, b) = 0.0;
      }
    }
  }
  // Along a periodic axis, points a period apart are the same.
  const auto continuation = [&](int axis, int count, auto&& at) {
    if (grid_.periodic[axis]) {
      const int period = grid_.cells[axis];
      if (count > period) at(period) = at(0);
      at(-1) = at(period - 1);
      at(count) = at(count - period);
    } else {
      at(-1) = !grid_.mirror[axis] ? 2 * at(0) - at(1) : plane.component == axis ? -at(1) : at(0);
      at(count) = 2 * at(count - 1) - at(count - 2);
    }
  };
  for (int b = 0; b < count_b; ++b) {
    continuation(axis_a, count_a, [&](int a) -> double& { return plane.at(a, b); });
  }
  for (int a = -1; a <= count_a; ++a) {
    continuation(axis_b, count_b, [&](int b) -> double& { return plane.at(a, b); });
  }
}

void WallVelocity::balance_flux() {
  double net = 0.0;
  double gross = 0.0;
  double area = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double face_area = grid_.cell_volume() / grid_.spacing(axis);
    for (int side = 0; side < 2; ++side) {
      if (!grid_.has_wall(axis, side)) continue;
      const Plane& wall = plane(axis, axis, side);
      double sum = 0.0;
      for (int b = 0; b < wall.extent[1]; ++b) {
        for (int a = 0; a < wall.extent[0]; ++a) {
          sum += wall.at(a, b);
          gross += std::abs(wall.at(a, b)) * face_area;
        }
      }
      net += (side == 0 ? -sum : sum) * face_area;
      area += face_area * wall.extent[0] * wall.extent[1];
    }
  }
  net_flux_ = net;
  // Balanced up to round-off: leave the data exactly as given.
  if (std::abs(net) <= 64 * std::numeric_limits<double>::epsilon() * gross) return;
  if (std::abs(net) > max_relative_flux * gross) {
    throw std::invalid_argument(message("boundary: the net outward flux through the walls is ", net, " at time ", time_,
                                        ", with |u.n| integrating to ", gross,
                                        "; an incompressible fluid needs zero (a relative ", max_relative_flux,
                                        " is accepted as the error of sampling)"));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (!grid_.has_wall(axis, side)) continue;
      const double correction = (side == 0 ? net : -net) / area;
      for (double& value : planes_[axis * 6 + axis * 2 + side].values) value += correction;
    }
  }
}

void WallVelocity::set_normal_faces(FaceVector& u) const {
  check_grid("boundary", "u", u, grid_);
  const auto fields = u.points();
  for (int axis = 0; axis < 3; ++axis) {
    const View& field = fields[axis];
    const auto [axis_a, axis_b] = wall_axes[axis];
    const std::ptrdiff_t last = (field.extent[axis] - 1) * stride(field, axis);
    const Plane& low = plane(axis, axis, 0);
    const Plane& high = plane(axis, axis, 1);
    for (int b = 0; b < low.extent[1]; ++b) {
      for (int a = 0; a < low.extent[0]; ++a) {
        double* face = field.data + a * stride(field, axis_a) + b * stride(field, axis_b);
        if (grid_.has_wall(axis, 0)) face[0] = low.at(a, b);
        if (grid_.mirror[axis]) face[0] = 0.0;
        face[last] = grid_.periodic[axis] ? face[0] : high.at(a, b);
      }
    }
  }
}

// Axis x first, then y, then z: each sweep also covers the ghosts that earlier ones have set, so that edges and corners
// are filled too.
void WallVelocity::fill_ghosts(FaceVector& u) const {
  check_grid("boundary", "u", u, grid_);
  const auto fields = u.points();
  for (int component = 0; component < 3; ++component) {
    const View& field = fields[component];
    for (int axis = 0; axis < 3; ++axis) {
      if (grid_.periodic[axis]) {
        repeat_into_ghosts(field, axis, grid_.cells[axis]);
        continue;
      }
      if (grid_.mirror[axis]) reflect_into_ghosts(field, axis, component == axis);
      for (int side = 0; side < 2; ++side) {
        if (grid_.has_wall(axis, side)) fill_wall_ghosts(plane(component, axis, side), field);
      }
    }
  }
}

void WallVelocity::fill_wall_ghosts(const Plane& wall, const View& field) const {
  const int axis = wall.axis;
  const auto [axis_a, axis_b] = wall_axes[axis];
  const bool on_wall = wall.component == axis;
  const std::ptrdiff_t inward = wall.side == 0 ? stride(field, axis) : -stride(field, axis);
  double* ghosts = field.data + (wall.side == 0 ? -1 : field.extent[axis]) * stride(field, axis);
  const int from_a = axis_a < axis ? -1 : 0;
  const int from_b = axis_b < axis ? -1 : 0;
  for (int b = from_b; b < wall.extent[1] - from_b; ++b) {
    for (int a = from_a; a < wall.extent[0] - from_a; ++a) {
      double* ghost = ghosts + a * stride(field, axis_a) + b * stride(field, axis_b);
      *ghost = on_wall ? 2 * ghost[inward] - ghost[2 * inward] : 2 * wall.at(a, b) - ghost[inward];
    }
  }
}

// Of one wall, with value(a, b) there.
template <class Value>
void WallVelocity::add_wall_diffusion(const Plane& wall, double mu, FaceVector& rhs, const Value& value) const {
  const View field = rhs.points()[wall.component];
  const int axis = wall.axis;
  const auto [axis_a, axis_b] = wall_axes[axis];
  const bool on_wall = wall.component == axis;
  const double h = grid_.spacing(axis);
  const double factor = mu * (on_wall ? 1.0 : 2.0) / (h * h);
  const int inset = on_wall ? 1 : 0;
  double* first = field.data + (wall.side == 0 ? inset : field.extent[axis] - 1 - inset) * stride(field, axis);
  // Along the wall, the points of the component that lie on other walls or mirrors are not unknowns.
  const Centring centring = face_centrings[wall.component];
  const auto unknowns = unknown_extent(grid_, centring);
  const int first_a = first_unknown(grid_, centring, axis_a);
  const int first_b = first_unknown(grid_, centring, axis_b);
  for (int b = first_b; b < first_b + unknowns[axis_b]; ++b) {
    for (int a = first_a; a < first_a + unknowns[axis_a]; ++a) {
      first[a * stride(field, axis_a) + b * stride(field, axis_b)] += factor * value(a, b);
    }
  }
}

void WallVelocity::add_diffusion(double mu, FaceVector& rhs) const {
  check_grid("boundary", "rhs", rhs, grid_);
  for (const Plane& wall : planes_) {
    if (!grid_.has_wall(wall.axis, wall.side)) continue;
    add_wall_diffusion(wall, mu, rhs, [&](int a, int b) { return wall.at(a, b); });
  }
}

void WallVelocity::add_diffusion_of_change(double mu, FaceVector& rhs) const {
  check_grid("boundary", "rhs", rhs, grid_);
  if (steady()) return;
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    const Plane& now = planes_[p];
    const Plane& before = spare_planes_[p];
    if (!grid_.has_wall(now.axis, now.side)) continue;
    add_wall_diffusion(now, mu, rhs, [&](int a, int b) { return now.at(a, b) - before.at(a, b); });
  }
}

}  // namespace vesiflow::fluid
