// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "transfer/fine_surface.h"

namespace vesiflow::coupling {

/// The foot of a point next to a surface is the point of the surface closest to it.
struct Foot {
  FineSurface::Place place;
  double distance;  ///< signed, of the point from its foot; positive outside
};

/// A point whose foot is looked for, and a node of the surface next to the foot.
struct FootQuery {
  Eigen::Vector3d point;
  FineSurface::Node near;
};

/// So many are looked for at a time.
inline constexpr int feet_at_a_time = 64;

/// Finds feet by Newton's method: with X and n at a point of the surface, S = grad_s n there, r = x - X, d = r . n and
/// t = r - d n, the foot of x is off by (1 + d S)^-1 t, and x at the distance d + t . S (1 + d S)^-1 t / 2 from it to
/// second order. The steps converge quadratically.
/// \param close where |t| is less, one more step is the last.
void find_feet(const FineSurface& surface, std::span<const FootQuery> queries, double close, std::span<Foot> feet);

}  // namespace vesiflow::coupling
