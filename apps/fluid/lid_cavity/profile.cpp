// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

using namespace vesiflow::fluid;

namespace cavity {
namespace {

constexpr int stencil = 4;

// Lagrange weights of four nodes for a position.
std::array<double, stencil> lagrange_weights(const double* nodes, double position) {
  std::array<double, stencil> weights{};
  for (int a = 0; a < stencil; ++a) {
    weights[a] = 1;
    for (int b = 0; b < stencil; ++b)
      if (b != a) weights[a] *= (position - nodes[b]) / (nodes[a] - nodes[b]);
  }
  return weights;
}

// The four points of a component around the middle of the box along an axis, and their weights.
struct Middle {
  int first;
  std::array<double, stencil> weights;
};

Middle middle(const Grid& grid, Centring centring, int axis) {
  const double offset = is_face_normal(centring, axis) ? 0.0 : 0.5;
  const double index = 0.5 * grid.cells[axis] - offset;
  // With an even number of points to choose from on both sides the stencil is symmetric, or the middle is one of its points.
  const int first = static_cast<int>(std::floor(index)) - 1;
  std::array<double, stencil> nodes{};
  for (int a = 0; a < stencil; ++a) nodes[a] = first + a;
  return {first, lagrange_weights(nodes.data(), index)};
}

// The value at point `index` of the line.
double at_middle(const ConstView& field, const std::array<int, 2>& across, const std::array<Middle, 2>& middles,
                 int axis, int index) {
  double value = 0;
  for (int a = 0; a < stencil; ++a)
    for (int b = 0; b < stencil; ++b) {
      std::array<int, 3> point{};
      point[axis] = index;
      point[across[0]] = middles[0].first + a;
      point[across[1]] = middles[1].first + b;
      value += middles[0].weights[a] * middles[1].weights[b] * field(point[0], point[1], point[2]);
    }
  return value;
}

Extremum lowest(const Profile& profile, double sign) {
  const auto better = [sign](double a, double b) { return sign * a < sign * b; };
  const auto node = std::min_element(profile.values.begin(), profile.values.end(), better) - profile.values.begin();
  const auto last = static_cast<std::ptrdiff_t>(profile.values.size()) - 1;
  const double from = profile.positions[static_cast<std::size_t>(std::max<std::ptrdiff_t>(node - 1, 0))];
  const double to = profile.positions[static_cast<std::size_t>(std::min<std::ptrdiff_t>(node + 1, last))];
  constexpr int samples = 2000;  // an error of 1e-6 h^2 times the second derivative
  Extremum best{from, profile.at(from)};
  for (int s = 1; s <= samples; ++s) {
    const double position = std::min(to, from + (to - from) * s / samples);
    const double value = profile.at(position);
    if (better(value, best.value)) best = {position, value};
  }
  return best;
}

}  // namespace

double Profile::at(double position) const {
  if (!(position >= positions.front() && position <= positions.back()))
    throw std::invalid_argument(
        fmt::format("position {} is not from {} to {}", position, positions.front(), positions.back()));
  const auto above = std::upper_bound(positions.begin(), positions.end(), position) - positions.begin();
  const auto last_first = static_cast<std::ptrdiff_t>(positions.size()) - stencil;
  const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - stencil / 2, 0, last_first));
  const auto weights = lagrange_weights(&positions[first], position);
  double value = 0;
  for (std::size_t a = 0; a < stencil; ++a) value += weights[a] * values[first + a];
  return value;
}

Extremum Profile::minimum() const {
  return lowest(*this, 1);
}

Extremum Profile::maximum() const {
  return lowest(*this, -1);
}

Profile centreline(const FaceVector& velocity, int component, int axis) {
  const Grid& grid = velocity.grid();
  const Centring centring = face_centrings[component];
  const std::array<int, 2> across = axis == 0 ? std::array{1, 2} : axis == 1 ? std::array{0, 2} : std::array{0, 1};
  const std::array<Middle, 2> middles{middle(grid, centring, across[0]), middle(grid, centring, across[1])};
  const ConstView field = velocity.points()[component];
  const auto value = [&](int index) { return at_middle(field, across, middles, axis, index); };
  const int points = field.extent[axis];

  Profile profile;
  const auto add = [&](double position, double found) {
    profile.positions.push_back(position);
    profile.values.push_back(found);
  };
  add(grid.lower[axis], 0.5 * (value(-1) + value(0)));
  for (int index = 0; index < points; ++index) add(grid.lower[axis] + (index + 0.5) * grid.spacing(axis), value(index));
  add(grid.upper[axis], 0.5 * (value(points - 1) + value(points)));
  return profile;
}

}  // namespace cavity
