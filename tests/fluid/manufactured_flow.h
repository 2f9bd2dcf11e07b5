// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// A forced flow in closed form, with constant or variable viscosity, and the error of a computed one.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "fluid/navier_stokes.h"
#include "test_fields.h"

namespace vesiflow::fluid::test {

// On [-3,3]^3, with k = pi/6 and cyclic (a, b, c) = (x, y, z):
//   u_a = -k (sin 2ka sin kb + 2 cos ka cos 2kc) cos t,   p = sin ky cos 2kx cos 2kz sin(t + 1/3),
//   mu = 1 + (ratio - 1)/2 (1 - tanh((|r|^2 - 1) / width)),
// and the force that drives it. If it is steady, it stays as it is at t = 1/4.
struct ManufacturedFlow {
  double reynolds_number = 1.0;
  double ratio = 1.0;
  double width = 0.5;
  bool steady = false;
  static constexpr double k = std::numbers::pi / 6;

  Vector3 velocity(const Vector3& r, double t) const {
    Vector3 u;
    for (int i = 0; i < 3; ++i) {
      const auto [a, b, c] = cyclic(r, i);
      u[i] =
          -k * (std::sin(2 * k * a) * std::sin(k * b) + 2 * std::cos(k * a) * std::cos(2 * k * c)) * std::cos(phase(t));
    }
    return u;
  }

  double pressure(const Vector3& r, double t) const {
    return std::sin(k * r[1]) * std::cos(2 * k * r[0]) * std::cos(2 * k * r[2]) * std::sin(phase(t) + 1.0 / 3);
  }

  double viscosity(const Vector3& r) const { return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh(argument(r))); }

  // Re (du/dt + u.grad u) + grad p - mu Lap u - (grad u + grad u^T) grad mu.
  Vector3 force(const Vector3& r, double t) const {
    const Vector3 u = velocity(r, t);
    const auto gradient = velocity_gradient(r, t);
    const Vector3 pressure_slope = pressure_gradient(r, t);
    const double slope = -(ratio - 1.0) / (width * std::pow(std::cosh(argument(r)), 2));  // grad mu = slope r
    Vector3 f = pressure_slope;
    for (int i = 0; i < 3; ++i) {
      f[i] += viscosity(r) * 5 * k * k * u[i];
      for (int j = 0; j < 3; ++j) f[i] -= slope * r[j] * (gradient[i][j] + gradient[j][i]);
      if (!steady) f[i] -= reynolds_number * u[i] * std::tan(t);
      for (int j = 0; j < 3; ++j) f[i] += reynolds_number * u[j] * gradient[i][j];
    }
    return f;
  }

 private:
  double phase(double t) const { return steady ? 0.25 : t; }
  double argument(const Vector3& r) const { return (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] - 1.0) / width; }
  static Vector3 cyclic(const Vector3& r, int i) { return {r[i], r[(i + 1) % 3], r[(i + 2) % 3]}; }

  // [i][j] = d u_i / d x_j.
  std::array<Vector3, 3> velocity_gradient(const Vector3& r, double t) const {
    std::array<Vector3, 3> gradient{};
    for (int i = 0; i < 3; ++i) {
      const auto [a, b, c] = cyclic(r, i);
      const double factor = -k * std::cos(phase(t));
      gradient[i][i] = factor * 2 * k * (std::cos(2 * k * a) * std::sin(k * b) - std::sin(k * a) * std::cos(2 * k * c));
      gradient[i][(i + 1) % 3] = factor * k * std::sin(2 * k * a) * std::cos(k * b);
      gradient[i][(i + 2) % 3] = -factor * 4 * k * std::cos(k * a) * std::sin(2 * k * c);
    }
    return gradient;
  }

  Vector3 pressure_gradient(const Vector3& r, double t) const {
    const double strength = std::sin(phase(t) + 1.0 / 3);
    const double sy = std::sin(k * r[1]), cx = std::cos(2 * k * r[0]), cz = std::cos(2 * k * r[2]);
    return {-2 * k * sy * std::sin(2 * k * r[0]) * cz * strength, k * std::cos(k * r[1]) * cx * cz * strength,
            -2 * k * sy * cx * std::sin(2 * k * r[2]) * strength};
  }
};

template <class Function>
void sample_faces(FaceVector& u, Function&& function) {
  const auto fields = u.points();
  for (int c = 0; c < 3; ++c) {
    for_each_point(fields[c].extent, [&](int i, int j, int k) {
      fields[c](i, j, k) = function(point_position(u.grid(), face_centrings[c], i, j, k))[c];
    });
  }
}

// Without its mean.
template <class Function>
Field<Cell> sample_pressure(const Grid& grid, Function&& function) {
  Field<Cell> p(grid);
  double sum = 0.0;
  for_each_point(p.extent(), [&](int i, int j, int k) { sum += p(i, j, k) = function(p.position(i, j, k)); });
  const double mean = sum / static_cast<double>(grid.cell_count());
  for_each_point(p.extent(), [&](int i, int j, int k) { p(i, j, k) -= mean; });
  return p;
}

struct FlowErrors {
  double velocity_l2, velocity_max, pressure_l2;
};

template <class Flow>
FlowErrors flow_errors(const FaceVector& velocity, const Field<Cell>& pressure, const Flow& flow, double t) {
  const Grid& grid = velocity.grid();
  FaceVector u(grid);
  sample_faces(u, [&](const Vector3& r) { return flow.velocity(r, t); });
  Field<Cell> p = sample_pressure(grid, [&](const Vector3& r) { return flow.pressure(r, t); });
  FlowErrors result{0.0, max_difference(u, velocity), 0.0};
  for (int c = 0; c < 3; ++c) {
    const View exact = u.points()[c];
    const ConstView computed = velocity.points()[c];
    for_each_point(exact.extent, [&](int i, int j, int k) { exact(i, j, k) -= computed(i, j, k); });
  }
  for_each_point(p.extent(), [&](int i, int j, int k) { p(i, j, k) -= pressure(i, j, k); });
  result.velocity_l2 = std::sqrt(grid.cell_volume() * dot(u, u));
  result.pressure_l2 = std::sqrt(grid.cell_volume() * dot(p.points(), p.points()));
  return result;
}

inline double slope(double coarse_error, int coarse_cells, double fine_error, int fine_cells) {
  return std::log(coarse_error / fine_error) / std::log(static_cast<double>(fine_cells) / coarse_cells);
}

}  // namespace vesiflow::fluid::test
