// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/feet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vesiflow::coupling {
namespace {

constexpr int most_steps = 8;

/// atan x of |x| < 1/4, by Taylor's series: the first term that lacks is below rounding.
constexpr double largest_tangent = 0.25;
double angle_of_tangent(double x) {
  constexpr int terms = 12;
  const double square = x * x;
  double sum = 0.0;
  for (int k = terms - 1; k >= 0; --k) sum = (k % 2 == 0 ? 1.0 : -1.0) / (2 * k + 1) + square * sum;
  return x * sum;
}

/// Points on their way to their feet, many at a time: the loop over them is vectorised, and while one waits for a
/// division there is work for the others. Their number is rounded up to whole lanes, so that the instructions that treat
/// a point do not depend on its place among the others.
class Walkers {
 public:
  static constexpr int most = feet_at_a_time;

  Walkers(const FineSurface& surface, double close) : surface_(surface), close_squared_(close * close) {}

  void find(std::span<const FootQuery> queries, std::span<Foot> feet) {
    start(queries);
    for (int steps = 1; count_ > 0; ++steps) {
      step();
      find_places();
      finish(feet, steps == most_steps);
      for (int i = 0; i < count_; ++i) look(i, surface_.at(place_[at(i)]));
    }
  }

 private:
  static constexpr int lanes = 8;
  template <class T>
  using PerPoint = std::array<T, most>;
  template <class T>
  using Vectors = std::array<PerPoint<T>, 3>;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int rounded() const { return (count_ + lanes - 1) / lanes * lanes; }

  void start(std::span<const FootQuery> queries) {
    count_ = static_cast<int>(queries.size());
    for (int i = 0; i < rounded(); ++i) {
      // What is beyond the last repeats it.
      const FootQuery& query = queries[at(std::min(i, count_ - 1))];
      const FineSurface::Direction s = surface_.mesh().direction_of(query.near);
      for (int k = 0; k < 3; ++k) {
        point_[at(k)][at(i)] = query.point[k];
        direction_[at(k)][at(i)] = s[k];
      }
      const ParameterMesh::Angles angles = surface_.mesh().angles_of(query.near);
      cos_theta_[at(i)] = angles.cos_theta;
      sin_theta_[at(i)] = angles.sin_theta;
      cos_phi_[at(i)] = angles.cos_phi;
      sin_phi_[at(i)] = angles.sin_phi;
      near_[at(i)] = query.near;
      number_[at(i)] = i;
      look(i, surface_.at(query.near));
    }
  }

  void look(int i, const SurfacePoint& surface) {
    for (int k = 0; k < 3; ++k) {
      position_[at(k)][at(i)] = surface.position_and_normal[k];
      normal_[at(k)][at(i)] = surface.position_and_normal[4 + k];
    }
    for (int k = 0; k < 15; ++k) slopes_[at(k)][at(i)] = surface.slopes[k];
  }

  void step() {
    const int n = rounded();
#pragma omp simd
    for (int i = 0; i < n; ++i) {
      const double rx = point_[0][at(i)] - position_[0][at(i)], ry = point_[1][at(i)] - position_[1][at(i)],
                   rz = point_[2][at(i)] - position_[2][at(i)];
      const double nx = normal_[0][at(i)], ny = normal_[1][at(i)], nz = normal_[2][at(i)];
      const double distance = rx * nx + ry * ny + rz * nz;
      const double tx = rx - distance * nx, ty = ry - distance * ny, tz = rz - distance * nz;
      offset_squared_[at(i)] = tx * tx + ty * ty + tz * tz;

      const auto d = static_cast<float>(distance), x = static_cast<float>(tx), y = static_cast<float>(ty),
                 z = static_cast<float>(tz);
      const float xx = slopes_[9][at(i)], yy = slopes_[10][at(i)], zz = slopes_[11][at(i)];
      const float xy = slopes_[12][at(i)], yz = slopes_[13][at(i)], zx = slopes_[14][at(i)];
      const float bent_x = xx * x + xy * y + zx * z, bent_y = xy * x + yy * y + yz * z,
                  bent_z = zx * x + yz * y + zz * z;
      // S has two eigenvalues other than zero, of the sum kappa and the product K: the inverse on the tangent plane is
      // (1 + d (kappa - S)) / (1 + d kappa + d^2 K).
      const float kappa = xx + yy + zz;
      const float gaussian = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
      const float determinant = 1.0F + d * (kappa + d * gaussian);
      // Beyond the centre of a curvature the step would go the wrong way.
      const bool is_before = determinant > 0.1F;
      const float divisor = is_before ? 1.0F / determinant : 1.0F;
      const float a = is_before ? divisor * (1.0F + d * kappa) : 1.0F, b = is_before ? divisor * d : 0.0F;
      const float along_x = a * x - b * bent_x, along_y = a * y - b * bent_y, along_z = a * z - b * bent_z;
      distance_[at(i)] =
          distance + static_cast<double>(0.5F * (along_x * bent_x + along_y * bent_y + along_z * bent_z));

      const float gx = slopes_[0][at(i)] * along_x + slopes_[1][at(i)] * along_y + slopes_[2][at(i)] * along_z;
      const float gy = slopes_[3][at(i)] * along_x + slopes_[4][at(i)] * along_y + slopes_[5][at(i)] * along_z;
      const float gz = slopes_[6][at(i)] * along_x + slopes_[7][at(i)] * along_y + slopes_[8][at(i)] * along_z;
      double sx = direction_[0][at(i)] + static_cast<double>(gx), sy = direction_[1][at(i)] + static_cast<double>(gy),
             sz = direction_[2][at(i)] + static_cast<double>(gz);
      const double scale = 1.0 / std::sqrt(sx * sx + sy * sy + sz * sz);
      sx *= scale;
      sy *= scale;
      sz *= scale;
      direction_[0][at(i)] = sx;
      direction_[1][at(i)] = sy;
      direction_[2][at(i)] = sz;

      // South and east of the node.
      const double level = std::sqrt(sx * sx + sy * sy);
      const double south = cos_theta_[at(i)] * level - sin_theta_[at(i)] * sz,
                   up = cos_theta_[at(i)] * sz + sin_theta_[at(i)] * level;
      const double east = cos_phi_[at(i)] * sy - sin_phi_[at(i)] * sx,
                   out = cos_phi_[at(i)] * sx + sin_phi_[at(i)] * sy;
      const double near_south = std::abs(south) < largest_tangent * up ? 1.0 : 0.0;
      const double near_east = std::abs(east) < largest_tangent * out ? 1.0 : 0.0;
      is_near_[at(i)] = near_south * near_east;
      south_[at(i)] = angle_of_tangent(south / up);
      east_[at(i)] = angle_of_tangent(east / out);
    }
  }

  void find_places() {
    for (int i = 0; i < count_; ++i)
      if (is_near_[at(i)] != 0.0)
        place_[at(i)] = surface_.mesh().place_at(near_[at(i)], south_[at(i)], east_[at(i)]);
      else
        place_[at(i)] = surface_.mesh().place_of({direction_[0][at(i)], direction_[1][at(i)], direction_[2][at(i)]});
  }

  // Takes out those that have arrived, and closes up.
  void finish(std::span<Foot> feet, bool all) {
    int rest = 0;
    for (int i = 0; i < count_; ++i) {
      if (all || offset_squared_[at(i)] <= close_squared_) {
        feet[at(number_[at(i)])] = {place_[at(i)], distance_[at(i)]};
        continue;
      }
      if (rest++ == i) continue;
      const auto move = [&](auto& values) { values[at(rest - 1)] = values[at(i)]; };
      for (int k = 0; k < 3; ++k) {
        move(point_[at(k)]);
        move(direction_[at(k)]);
      }
      move(cos_theta_);
      move(sin_theta_);
      move(cos_phi_);
      move(sin_phi_);
      move(near_);
      move(number_);
      move(place_);
    }
    count_ = rest;
  }

  const FineSurface& surface_;
  double close_squared_;
  int count_ = 0;
  alignas(64) Vectors<double> point_, direction_;
  PerPoint<double> cos_theta_, sin_theta_, cos_phi_, sin_phi_;  // of the node near it
  PerPoint<FineSurface::Node> near_;
  PerPoint<int> number_;  // of its query
  PerPoint<FineSurface::Place> place_;
  alignas(64) Vectors<double> position_, normal_;  // of the surface, where it is on the way
  std::array<PerPoint<float>, 15> slopes_;
  PerPoint<double> offset_squared_, distance_, south_, east_, is_near_;
};

}  // namespace

void find_feet(const FineSurface& surface, std::span<const FootQuery> queries, double close, std::span<Foot> feet) {
  Walkers walkers(surface, close);
  for (std::size_t begin = 0; begin < queries.size(); begin += Walkers::most) {
    const std::size_t count = std::min<std::size_t>(Walkers::most, queries.size() - begin);
    walkers.find(queries.subspan(begin, count), feet.subspan(begin, count));
  }
}

}  // namespace vesiflow::coupling
