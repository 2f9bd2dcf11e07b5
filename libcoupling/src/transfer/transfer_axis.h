// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace vesiflow::coupling {

/// One axis of the grid as the supports of markers see it: walls, periodic, or a mirror plane at the lower end.
struct TransferAxis {
  int cells;
  bool periodic, mirrored;
  bool one_sided;  // of a mirrored one: markers are on the box's side only
  double lower, per_spacing;
  double wall_clearance;  // in grid spacings

  /// Coordinate in grid spacings from the lower end, where the marker's weights are taken: in the box on a periodic axis, on
  /// the box's side of a mirror plane.
  struct Place {
    double s;
    bool reflected;
    bool allowed;
  };
  Place place(double position) const {
    double s = (position - lower) * per_spacing;
    if (periodic) {
      s -= cells * std::floor(s / cells);
      if (s >= cells) s = 0.0;  // round-off just below the lower end
      return {s, false, s >= 0.0};
    }
    const bool reflected = mirrored && s < 0.0;
    if (mirrored) s = std::abs(s);
    const bool low_enough = s < cells - wall_clearance;
    return {s, reflected, (mirrored ? !(one_sided && reflected) : s >= wall_clearance) && low_enough};
  }

  /// On a periodic axis: point i of -cells .. 2 cells - 1 by its number in the box.
  int wrapped(int i) const { return i < 0 ? i + cells : i < cells ? i : i - cells; }
};

/// The points under one function along one axis: `first` and those above it.
template <int width>
struct AxisStencil {
  std::int32_t first;
  std::array<double, width> weights;
};

/// Weights at `s` (in grid spacings from point 0).
template <class Function>
[[gnu::always_inline]] inline AxisStencil<Function::width> stencil_at(double s) {
  const double x = s - 0.5 * Function::width, below = std::floor(x);
  return {static_cast<std::int32_t>(below) + 1, Function::weights(x - below)};
}

/// Takes what lies beyond a mirror plane at the lower end to the points on this side. Faces: point -i is i, with the other
/// sign (the component is normal to the plane), and point 0, on the plane, has no part. Centres: point -1 - i is i.
template <int width>
void fold_faces(AxisStencil<width>& stencil, bool reflected) {
  if (reflected)
    for (double& w : stencil.weights) w = -w;
  if (stencil.first > 0) return;
  const auto beyond = stencil.weights;
  const int plane = -stencil.first;  // where point 0 is in `beyond`
  for (int i = 0; i < width; ++i)
    stencil.weights[i] = (plane + i < width ? beyond[plane + i] : 0.0) - (plane - i >= 0 ? beyond[plane - i] : 0.0);
  stencil.first = 0;
}
template <int width>
void fold_centres(AxisStencil<width>& stencil) {
  if (stencil.first >= 0) return;
  const auto beyond = stencil.weights;
  const int start = -stencil.first;
  for (int i = 0; i < width; ++i)
    stencil.weights[i] =
        (start + i < width ? beyond[start + i] : 0.0) + (start - 1 - i >= 0 ? beyond[start - 1 - i] : 0.0);
  stencil.first = 0;
}

}  // namespace vesiflow::coupling
