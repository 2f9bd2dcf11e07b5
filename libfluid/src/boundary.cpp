#include "fluid/boundary.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "message.h"

namespace vesiflow::fluid {
namespace {

// The two axes along a wall, in increasing order.
constexpr std::array<std::array<int, 2>, 3> wall_axes{{{1, 2}, {0, 2}, {0, 1}}};

std::ptrdiff_t stride(const View& field, int axis) {
  return axis == 0 ? 1 : axis == 1 ? field.row_stride : field.plane_stride;
}

constexpr Centring component_centring(int component) {
  return static_cast<Centring>(component + 1);
}

}  // namespace

WallVelocity::WallVelocity(const Grid& grid, BoundaryVelocity velocity, bool steady)
    : grid_(grid), velocity_(std::move(velocity)), steady_(steady) {
  if (!velocity_) throw std::invalid_argument("boundary: the velocity of the walls is an empty function");
  for (int component = 0; component < 3; ++component) {
    const auto extent = point_extent(grid, component_centring(component));
    for (int axis = 0; axis < 3; ++axis) {
      const std::array<int, 2> along{extent[wall_axes[axis][0]], extent[wall_axes[axis][1]]};
      const std::vector<double> values(static_cast<std::size_t>(along[0] + 2) * (along[1] + 2));
      for (int side = 0; side < 2; ++side) planes_.push_back({component, axis, side, along, values});
    }
  }
  for (Plane& plane : planes_) sample(plane);
  balance_flux();
}

void WallVelocity::evaluate(double time) {
  if (steady_ || time == time_) return;
  time_ = time;
  for (Plane& plane : planes_) sample(plane);
  balance_flux();
}

void WallVelocity::sample(Plane& plane) const {
  const auto [axis_a, axis_b] = wall_axes[plane.axis];
  const auto [count_a, count_b] = plane.extent;
  for (int b = 0; b < count_b; ++b) {
    for (int a = 0; a < count_a; ++a) {
      std::array<int, 3> index{};
      index[axis_a] = a;
      index[axis_b] = b;
      Vector3 position = point_position(grid_, component_centring(plane.component), index[0], index[1], index[2]);
      position[plane.axis] = plane.side == 0 ? grid_.lower[plane.axis] : grid_.upper[plane.axis];
      const double value = velocity_(position, time_)[plane.component];
      if (!std::isfinite(value)) {
        throw std::invalid_argument(message("boundary: velocity component ", plane.component, " is ", value, " at (",
                                            position[0], ", ", position[1], ", ", position[2], "), time ", time_));
      }
      plane.at(a, b) = value;
    }
  }
  for (int b = 0; b < count_b; ++b) {
    plane.at(-1, b) = 2 * plane.at(0, b) - plane.at(1, b);
    plane.at(count_a, b) = 2 * plane.at(count_a - 1, b) - plane.at(count_a - 2, b);
  }
  for (int a = -1; a <= count_a; ++a) {
    plane.at(a, -1) = 2 * plane.at(a, 0) - plane.at(a, 1);
    plane.at(a, count_b) = 2 * plane.at(a, count_b - 1) - plane.at(a, count_b - 2);
  }
}

void WallVelocity::balance_flux() {
  double net = 0.0;
  double gross = 0.0;
  double area = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double face_area = grid_.cell_volume() / grid_.spacing(axis);
    for (int side = 0; side < 2; ++side) {
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
      const double correction = (side == 0 ? net : -net) / area;
      for (double& value : planes_[axis * 6 + axis * 2 + side].values) value += correction;
    }
  }
}

void WallVelocity::set_normal_faces(FaceVector& u) const {
  const auto fields = u.points();
  for (int axis = 0; axis < 3; ++axis) {
    const View& field = fields[axis];
    const auto [axis_a, axis_b] = wall_axes[axis];
    for (int side = 0; side < 2; ++side) {
      const Plane& wall = plane(axis, axis, side);
      double* start = field.data + (side == 0 ? 0 : field.extent[axis] - 1) * stride(field, axis);
      for (int b = 0; b < wall.extent[1]; ++b) {
        for (int a = 0; a < wall.extent[0]; ++a) {
          start[a * stride(field, axis_a) + b * stride(field, axis_b)] = wall.at(a, b);
        }
      }
    }
  }
}

void WallVelocity::fill_ghosts(FaceVector& u) const {
  const auto fields = u.points();
  for (const Plane& wall : planes_) {
    const View& field = fields[wall.component];
    const int axis = wall.axis;
    const auto [axis_a, axis_b] = wall_axes[axis];
    const bool on_wall = wall.component == axis;
    const std::ptrdiff_t inward = wall.side == 0 ? stride(field, axis) : -stride(field, axis);
    double* ghosts = field.data + (wall.side == 0 ? -1 : field.extent[axis]) * stride(field, axis);
    // Walls normal to x come first, then y, then z: each sweep also covers the ghosts that earlier ones have
    // set, so that edges and corners are filled too. The earlier axes are those with a smaller number.
    const int from_a = axis_a < axis ? -1 : 0;
    const int from_b = axis_b < axis ? -1 : 0;
    for (int b = from_b; b < wall.extent[1] - from_b; ++b) {
      for (int a = from_a; a < wall.extent[0] - from_a; ++a) {
        double* ghost = ghosts + a * stride(field, axis_a) + b * stride(field, axis_b);
        *ghost = on_wall ? 2 * ghost[inward] - ghost[2 * inward] : 2 * wall.at(a, b) - ghost[inward];
      }
    }
  }
}

void WallVelocity::add_diffusion(double mu, FaceVector& rhs) const {
  const auto fields = rhs.points();
  for (const Plane& wall : planes_) {
    const View& field = fields[wall.component];
    const int axis = wall.axis;
    const auto [axis_a, axis_b] = wall_axes[axis];
    const bool on_wall = wall.component == axis;
    const double h = grid_.spacing(axis);
    const double factor = mu * (on_wall ? 1.0 : 2.0) / (h * h);
    const int inset = on_wall ? 1 : 0;
    double* first = field.data + (wall.side == 0 ? inset : field.extent[axis] - 1 - inset) * stride(field, axis);
    // Along the wall, the points of the component that lie on other walls are not unknowns.
    const int skip_a = wall.component == axis_a ? 1 : 0;
    const int skip_b = wall.component == axis_b ? 1 : 0;
    for (int b = skip_b; b < wall.extent[1] - skip_b; ++b) {
      for (int a = skip_a; a < wall.extent[0] - skip_a; ++a) {
        first[a * stride(field, axis_a) + b * stride(field, axis_b)] += factor * wall.at(a, b);
      }
    }
  }
}

}  // namespace vesiflow::fluid
