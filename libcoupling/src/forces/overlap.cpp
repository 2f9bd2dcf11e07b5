// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/overlap.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "forces/periodic_images.h"

namespace vesiflow::coupling {
namespace {

// Solid angle under which a closed surface is seen from a point, over 4 pi: 1 inside, 0 outside, about 1/2 on it.
double winding_number(const vesicle::Surface& surface, const vesicle::Vector3& point) {
  double sum = 0.0;
  for (Eigen::Index m = 0; m < surface.positions().rows(); ++m) {
    const vesicle::Vector3 r = surface.positions().row(m).matrix().transpose() - point;
    const double distance = r.norm();
    if (distance == 0.0) continue;
    sum += r.dot(surface.normal().row(m).matrix()) * surface.area_weight()(m) / (distance * distance * distance);
  }
  return sum / (4.0 * std::numbers::pi);
}

// Below the 1/2 of a point on the surface, so that touching counts as overlapping.
constexpr double overlap_threshold = 0.25;

// Lowers `nearest` to the least distance between the markers of a and those of b + shift, if that is smaller.
void lower_to_distance(const vesicle::VectorField& a, const vesicle::VectorField& b, const Bounds& bounds_b,
                       const vesicle::Vector3& shift, double& nearest) {
  double squared = nearest * nearest;
  for (Eigen::Index m = 0; m < a.rows(); ++m) {
    const vesicle::Vector3 x = a.row(m).matrix().transpose() - shift;
    const vesicle::Vector3 outside = (bounds_b.lower - x).cwiseMax(x - bounds_b.upper).cwiseMax(0.0);
    if (outside.squaredNorm() >= squared) continue;
    const double least =
        ((b.col(0) - x(0)).square() + (b.col(1) - x(1)).square() + (b.col(2) - x(2)).square()).minCoeff();
    squared = std::min(squared, least);
  }
  nearest = std::sqrt(squared);
}

}  // namespace

bool overlap(const vesicle::Surface& surface, const vesicle::VectorField& markers, const vesicle::Vector3& shift) {
  const Bounds bounds(surface.positions());
  if (bounds.distance_to(Bounds(markers), shift) > 0.0) return false;
  for (Eigen::Index m = 0; m < markers.rows(); ++m) {
    const vesicle::Vector3 x = markers.row(m).matrix().transpose() + shift;
    if ((x.array() < bounds.lower.array()).any() || (x.array() > bounds.upper.array()).any()) continue;
    if (winding_number(surface, x) > overlap_threshold) return true;
  }
  return false;
}

std::vector<double> nearest_distances(const fluid::Grid& grid, std::span<const vesicle::VectorField* const> membranes) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<Bounds> bounds;
  for (const vesicle::VectorField* markers : membranes) bounds.emplace_back(*markers);
  // No image farther than the box is nearest: the one wrapped to within half a period along each axis is nearer.
  double range = 0.0;
  for (int axis = 0; axis < 3; ++axis) range += grid.length(axis);
  for (std::size_t a = 0; a < bounds.size(); ++a)
    range = std::max(range, (bounds[a].upper - bounds[a].lower).lpNorm<1>());
  std::vector<double> nearest(membranes.size(), infinite);
  // Of mirror images no other is nearer than a membrane's own, which each marker faces at twice its distance from the plane.
  for (std::size_t a = 0; a < membranes.size(); ++a)
    for (int axis = 0; axis < 3; ++axis)
      if (const double gap = bounds[a].lower(axis) - grid.lower[axis]; grid.mirror[axis] && gap >= 0.0)
        nearest[a] = std::min(nearest[a], 2.0 * gap);
  for (std::size_t a = 0; a < membranes.size(); ++a)
    for (std::size_t b = a; b < membranes.size(); ++b)
      for_each_image(grid, bounds[a], bounds[b], range, [&](const vesicle::Vector3& shift) {
        if (a == b && !is_first_of_two(shift)) return;
        double least = std::max(nearest[a], nearest[b]);
        if (bounds[a].distance_to(bounds[b], shift) >= least) return;
        lower_to_distance(*membranes[a], *membranes[b], bounds[b], shift, least);
        nearest[a] = std::min(nearest[a], least);
        nearest[b] = std::min(nearest[b], least);
      });
  return nearest;
}

double distance_to_walls(const fluid::Grid& grid, const vesicle::VectorField& markers) {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.periodic[axis]) continue;
    least = std::min(least, grid.upper[axis] - markers.col(axis).maxCoeff());
    if (!grid.mirror[axis]) least = std::min(least, markers.col(axis).minCoeff() - grid.lower[axis]);
  }
  return least;
}

}  // namespace vesiflow::coupling
