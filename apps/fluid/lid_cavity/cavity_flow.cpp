// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cavity_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fluid/navier_stokes.h"

using namespace vesiflow::fluid;

namespace cavity {
namespace {

constexpr double on_lid = 1.0;

Vector3 wall_velocity(const Vector3& position, double /*time*/) {
  return {position[1] == on_lid ? 1.0 : 0.0, 0.0, 0.0};
}

// Trilinear interpolation of one component; ghosts are read.
double interpolated(const FaceVector& velocity, int component, const Vector3& position) {
  const ConstView field = velocity.points()[component];
  const Vector3 first = point_position(velocity.grid(), face_centrings[component], 0, 0, 0);
  std::array<int, 3> below{};
  Vector3 fraction{};
  for (int axis = 0; axis < 3; ++axis) {
    const double index = (position[axis] - first[axis]) / velocity.grid().spacing(axis);
    below[axis] = std::clamp(static_cast<int>(std::floor(index)), -1, field.extent[axis] - 1);
    fraction[axis] = index - below[axis];
  }
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> point = below;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis) & 1;
      weight *= upper ? fraction[axis] : 1 - fraction[axis];
      point[axis] += upper;
    }
    value += weight * field(point[0], point[1], point[2]);
  }
  return value;
}

}  // namespace

CavityFlow compute_cavity(int cells, double reynolds_number, SteadyOptions options, const FaceVector* start) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {cells, cells, cells});
  FluidParameters parameters;
  parameters.reynolds_number = reynolds_number;
  NavierStokes fluid(grid, parameters, wall_velocity);
  if (start != nullptr)
    fluid.set_velocity([&](const Vector3& position) {
      return Vector3{interpolated(*start, 0, position), interpolated(*start, 1, position),
                     interpolated(*start, 2, position)};
    });
  options.time_scale = 1.0;
  options.largest_time_step = std::min(1.0, reynolds_number / (3 * std::numbers::pi * std::numbers::pi));
  const SteadyRun run = run_to_steady_state(fluid, options);
  const FaceVector& velocity = fluid.velocity();
  return {cells, run, velocity.clone(), centreline(velocity, 0, 1), centreline(velocity, 1, 0)};
}

std::vector<double> sampled(const Profile& profile, std::span<const PublishedPoint> points) {
  std::vector<double> values;
  for (const PublishedPoint& point : points) values.push_back(profile.at(point.position));
  return values;
}

double extrapolated(double coarse, double fine, double ratio) {
  return fine + (fine - coarse) / (ratio * ratio - 1);
}

Deviation deviation(std::span<const double> values, std::span<const PublishedPoint> points) {
  Deviation result{0, 0};
  for (std::size_t p = 0; p < points.size(); ++p) {
    const double difference = std::abs(values[p] - points[p].value);
    result.rms += difference * difference / static_cast<double>(points.size());
    result.max = std::max(result.max, difference);
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

}  // namespace cavity
