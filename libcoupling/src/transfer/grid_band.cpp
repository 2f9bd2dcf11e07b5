// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/grid_band.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vesiflow::coupling {
namespace {

using Vector = Eigen::Vector3d;

/// Every second node is enough to start from: the first projection is by the expansion about the node.
constexpr int node_stride = 2;
/// The steps converge quadratically: from here, in spacings, one more is exact to 1e-4 of a spacing.
constexpr double last_offset = 0.02;
constexpr int most_steps = 8;

/// A point of the surface with what a step of Newton's method to the foot of another point needs.
struct Foot {
  Vector position, normal;
  Eigen::Matrix3d direction_gradient, shape;

  template <class Read>
  static Foot read(Read&& value) {
    Foot foot;
    foot.position = value(FineSurface::position).template head<3>();
    foot.normal = value(FineSurface::normal).template head<3>();
    for (int i = 0; i < 3; ++i)
      foot.direction_gradient.row(i) = value(FineSurface::direction + i).template head<3>().matrix().transpose();
    const Eigen::Array4d s = value(FineSurface::shape), m = value(FineSurface::shape_mixed);
    foot.shape << s[0], m[0], m[2], m[0], s[1], m[1], m[2], m[1], s[2];
    return foot;
  }

  /// How far off it is along the surface.
  double offset(const Vector& x) const {
    const Vector r = x - position;
    return (r - r.dot(normal) * normal).norm();
  }

  /// The direction of the foot of x, by one step from this point of direction s. With r = x - X, d = r . n and the
  /// tangential part t of r the foot is off by (1 + d S)^-1 t.
  Vector towards(const Vector& x, const Vector& s) const {
    const Vector r = x - position;
    const double d = r.dot(normal);
    const Vector t = r - d * normal;
    const Eigen::Matrix3d m = Eigen::Matrix3d::Identity() + d * shape;
    // Beyond the centre of a curvature the step would go the wrong way.
    const double determinant = m.determinant();
    const Vector off = determinant > 0.1 ? Vector(m.inverse() * t) : t;
    return (s + direction_gradient * off).normalized();
  }
};

}  // namespace

GridBand::GridBand(const fluid::Grid& grid, fluid::Centring centring)
    : grid_(grid), centring_(centring), origin_(fluid::point_position(grid, centring, 0, 0, 0)) {
  for (int axis = 0; axis < 3; ++axis) spacing_[static_cast<std::size_t>(axis)] = grid.spacing(axis);
}

void GridBand::update(const FineSurface& surface, double width) {
  frame(surface, width);
  find_nearest_nodes(surface, width);
  project(surface, width);
}

void GridBand::evaluate(const FineSurface& surface, int record) {
  for (const FootOfPoint& foot : feet_) {
    const FineSurface::Four g = surface.value(foot.place, record);
    const double d = foot.distance;
    jump_[foot.point] = g[0] + d * (g[1] + 0.5 * d * (g[2] + d / 3.0 * g[3]));
  }
}

void GridBand::frame(const FineSurface& surface, double width) {
  Vector lower = Vector::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (int j = 0; j < surface.latitudes(); ++j)
    for (int i = 0; i < surface.longitudes(); ++i) {
      const Vector x = surface.at_node(i, j, FineSurface::position).head<3>();
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  std::size_t size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = spacing_[axis];
    first_[axis] = static_cast<int>(std::floor((lower[axis] - width - origin_[axis]) / h)) - 1;
    const int last = static_cast<int>(std::ceil((upper[axis] + width - origin_[axis]) / h)) + 1;
    extent_[axis] = last - first_[axis] + 1;
    size *= static_cast<std::size_t>(extent_[axis]);
  }
  distance_.assign(size, far);
  jump_.assign(size, 0.0);
  nearest_.assign(size, std::numeric_limits<float>::infinity());
  node_.assign(size, -1);
}

void GridBand::find_nearest_nodes(const FineSurface& surface, double width) {
  // Half of the diagonal between the nodes that are looked at, which are no further apart than 0.9 h each way.
  const double h = *std::max_element(spacing_.begin(), spacing_.end());
  const double reach = std::hypot(width, 0.7 * node_stride * h);
  const float most = static_cast<float>(reach * reach);
  std::array<int, 3> steps;
  for (int axis = 0; axis < 3; ++axis) steps[axis] = static_cast<int>(std::ceil(reach / spacing_[axis]));
  for (int j = 0; j < surface.latitudes(); ++j)
    for (int i = j % node_stride; i < surface.longitudes(); i += node_stride) {
      const auto x = surface.at_node(i, j, FineSurface::position);
      std::array<int, 3> low, high;
      for (int axis = 0; axis < 3; ++axis) {
        const int at = static_cast<int>(std::lround((x[axis] - origin_[axis]) / spacing_[axis]));
        low[axis] = std::max(at - steps[axis], first_[axis]);
        high[axis] = std::min(at + steps[axis], first_[axis] + extent_[axis] - 1);
      }
      const int number = j * surface.longitudes() + i;
      for (int c = low[2]; c <= high[2]; ++c) {
        const double dz = origin_[2] + c * spacing_[2] - x[2];
        for (int b = low[1]; b <= high[1]; ++b) {
          const double dy = origin_[1] + b * spacing_[1] - x[1];
          const double rest = dy * dy + dz * dz;
          const double left = reach * reach - rest;
          if (left < 0.0) continue;
          const double half = std::sqrt(left);
          const double middle = (x[0] - origin_[0]) / spacing_[0], wide = half / spacing_[0];
          const int from = std::max(low[0], static_cast<int>(std::ceil(middle - wide)));
          const int to = std::min(high[0], static_cast<int>(std::floor(middle + wide)));
          std::size_t at = static_cast<std::size_t>(offset(from, b, c));
          double dx = origin_[0] + from * spacing_[0] - x[0];
          for (int a = from; a <= to; ++a, ++at, dx += spacing_[0]) {
            const float square = static_cast<float>(dx * dx + rest);
            if (square < nearest_[at] && square <= most) {
              nearest_[at] = square;
              node_[at] = number;
            }
          }
        }
      }
    }
}

void GridBand::project(const FineSurface& surface, double width) {
  feet_.clear();
  const int longitudes = surface.longitudes();
  std::size_t at = 0;
  for (int k = 0; k < extent_[2]; ++k)
    for (int j = 0; j < extent_[1]; ++j)
      for (int i = 0; i < extent_[0]; ++i, ++at) {
        if (node_[at] < 0) continue;
        const Vector x(origin_[0] + (first_[0] + i) * spacing_[0], origin_[1] + (first_[1] + j) * spacing_[1],
                       origin_[2] + (first_[2] + k) * spacing_[2]);
        const int row = node_[at] / longitudes, column = node_[at] % longitudes;
        const Foot node = Foot::read([&](int r) { return FineSurface::Four(surface.at_node(column, row, r)); });
        Vector s = node.towards(x, surface.direction_of_node(column, row));
        FineSurface::Place place;
        for (int step = 0; step < most_steps; ++step) {
          place = surface.place_of(s);
          const Foot near = Foot::read([&](int r) { return surface.value(place, r); });
          s = near.towards(x, s);
          if (near.offset(x) < last_offset * spacing_[0]) break;
        }
        place = surface.place_of(s);
        const Vector foot = surface.value(place, FineSurface::position).head<3>();
        const Vector normal = surface.value(place, FineSurface::normal).head<3>();
        const Vector r = x - foot;
        const double side = r.dot(normal);
        const double d = std::copysign(r.norm(), side);
        if (std::abs(d) > width) continue;
        distance_[at] = d;
        feet_.push_back({at, d, place});
      }
}

}  // namespace vesiflow::coupling
