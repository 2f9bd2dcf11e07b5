// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/repulsion.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "forces/close_pairs.h"
#include "forces/periodic_images.h"

namespace vesiflow::coupling {
namespace {

RepulsionParameters checked(const RepulsionParameters& parameters) {
  if (!(parameters.range > 0.0 && std::isfinite(parameters.range)))
    throw std::invalid_argument(fmt::format("repulsion: range is {:g}; it must be finite and > 0", parameters.range));
  if (!(parameters.strength >= 0.0 && std::isfinite(parameters.strength)))
    throw std::invalid_argument(
        fmt::format("repulsion: strength is {:g}; it must be finite and >= 0", parameters.strength));
  return parameters;
}

void check(std::span<const RepelledMembrane> membranes, bool with_forces) {
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    const RepelledMembrane& membrane = membranes[i];
    if (membrane.positions == nullptr || membrane.area_weight == nullptr || (with_forces && membrane.force == nullptr))
      throw std::invalid_argument(fmt::format("repulsion: membrane {} lacks an array", i));
    const Eigen::Index markers = membrane.positions->rows(), areas = membrane.area_weight->rows();
    const Eigen::Index forces = with_forces ? membrane.force->rows() : markers;
    if (areas != markers || forces != markers)
      throw std::invalid_argument(
          fmt::format("repulsion: membrane {} has {} positions, {} areas and {} forces: must be as many", i, markers,
                      areas, forces));
  }
}

// visit(marker, axis, direction away from the wall, 1 - d/R) for every marker nearer to a wall than R.
template <class Visit>
void for_each_marker_near_a_wall(const fluid::Grid& grid, double range, const vesicle::VectorField& markers,
                                 Visit&& visit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.periodic[axis]) continue;
    for (Eigen::Index m = 0; m < markers.rows(); ++m) {
      const double above = 1.0 - (markers(m, axis) - grid.lower[axis]) / range;
      const double below = 1.0 - (grid.upper[axis] - markers(m, axis)) / range;
      if (above > 0.0 && grid.has_wall(axis, 0)) visit(m, axis, 1.0, above);
      if (below > 0.0 && grid.has_wall(axis, 1)) visit(m, axis, -1.0, below);
    }
  }
}

}  // namespace

// All close pairs of markers of all membranes, images by periods and mirrors included.
class Repulsion::Pairs {
 public:
  Pairs(double range, Eigen::Index largest_markers) : range_(range), close_(range, largest_markers) {}

  // visit(a, m, b, n, r, distance): marker m of membrane a, n of b (which may be an image of a), r from n to m.
  template <class Visit>
  void for_each(const fluid::Grid& grid, std::span<const RepelledMembrane> membranes, Visit&& visit) {
    bounds_.clear();
    for (const RepelledMembrane& membrane : membranes) bounds_.emplace_back(*membrane.positions);
    for (std::size_t a = 0; a < membranes.size(); ++a)
      for (std::size_t b = a; b < membranes.size(); ++b)
        for_each_image(grid, bounds_[a], bounds_[b], range_, [&](const vesicle::Vector3& shift) {
          if (a == b && !is_first_of_two(shift)) return;
          close_.visit(*membranes[a].positions, bounds_[a], *membranes[b].positions, bounds_[b], shift,
                       [&](Eigen::Index m, Eigen::Index n, const vesicle::Vector3& r, double distance) {
                         visit(a, m, b, n, r, distance);
                       });
        });
  }

  // visit(a, m, b, n, r, distance) after for_each: marker m of membrane a and the mirror image of n of b, r from that to m,
  // for all images of b in mirror planes but those that are b itself. Of a and the image of b, and b and that of a, which
  // are mirror images of each other, both are visited.
  template <class Visit>
  void for_each_mirrored(const fluid::Grid& grid, std::span<const RepelledMembrane> membranes, Visit&& visit) {
    constexpr int all_planes = 8;
    for (std::size_t b = 0; b < membranes.size(); ++b)
      for (int planes = 1; planes < all_planes; ++planes) {
        if (!make_image(grid, *membranes[b].positions, bounds_[b], planes)) continue;
        const Bounds bounds(image_);
        for (std::size_t a = 0; a < membranes.size(); ++a)
          for_each_image(grid, bounds_[a], bounds, range_, [&](const vesicle::Vector3& shift) {
            close_.visit(*membranes[a].positions, bounds_[a], image_, bounds, shift,
                         [&](Eigen::Index m, Eigen::Index n, const vesicle::Vector3& r, double distance) {
                           visit(a, m, b, n, r, distance);
                         });
          });
      }
  }

 private:
  // Sets image_ to the markers reflected in all of the planes, a bit for each axis. False if one of them is not there, or the
  // membrane lies across it.
  bool make_image(const fluid::Grid& grid, const vesicle::VectorField& markers, const Bounds& bounds, int planes) {
    for (int axis = 0; axis < 3; ++axis)
      if ((planes >> axis & 1) != 0 && !(grid.mirror[axis] && bounds.lower(axis) >= grid.lower[axis])) return false;
    image_ = markers;
    for (int axis = 0; axis < 3; ++axis)
      if ((planes >> axis & 1) != 0) image_.col(axis) = 2.0 * grid.lower[axis] - image_.col(axis);
    return true;
  }

  double range_;
  ClosePairs close_;
  std::vector<Bounds> bounds_;
  vesicle::VectorField image_;
};

Repulsion::Repulsion(const fluid::Grid& grid, const RepulsionParameters& parameters, Eigen::Index largest_markers)
    : pairs_(std::make_unique<Pairs>(checked(parameters).range, largest_markers)),
      grid_(grid),
      parameters_(parameters) {}

Repulsion::~Repulsion() = default;

void Repulsion::add_forces(std::span<const RepelledMembrane> membranes) {
  check(membranes, true);
  const double range = parameters_.range, strength = parameters_.strength;
  const double per_range_squared = 1.0 / (range * range), factor = strength / (2.0 * std::numbers::pi);
  const auto push = [&](const vesicle::Vector3& r, double distance) -> Eigen::Array<double, 1, 3> {
    const double slope = factor * (1.0 / (distance * distance) - per_range_squared);
    return (slope / distance * r).array().transpose();
  };
  pairs_->for_each(
      grid_, membranes,
      [&](std::size_t a, Eigen::Index m, std::size_t b, Eigen::Index n, const vesicle::Vector3& r, double distance) {
        const Eigen::Array<double, 1, 3> on_a = push(r, distance);
        membranes[a].force->row(m) += (*membranes[b].area_weight)(n)*on_a;
        membranes[b].force->row(n) -= (*membranes[a].area_weight)(m)*on_a;
      });
  pairs_->for_each_mirrored(
      grid_, membranes,
      [&](std::size_t a, Eigen::Index m, std::size_t b, Eigen::Index n, const vesicle::Vector3& r, double distance) {
        membranes[a].force->row(m) += (*membranes[b].area_weight)(n)*push(r, distance);
      });
  if (!parameters_.walls) return;
  for (const RepelledMembrane& membrane : membranes)
    for_each_marker_near_a_wall(grid_, range, *membrane.positions,
                                [&](Eigen::Index m, int axis, double away, double depth) {
                                  (*membrane.force)(m, axis) += away * strength * depth * depth;
                                });
}

double Repulsion::energy(std::span<const RepelledMembrane> membranes) {
  check(membranes, false);
  const double range = parameters_.range, strength = parameters_.strength;
  double sum = 0.0;
  const auto add = [&](double share) {
    return [&, share](std::size_t a, Eigen::Index m, std::size_t b, Eigen::Index n, const vesicle::Vector3&,
                      double distance) {
      const double depth = 1.0 - distance / range;
      sum += share * strength * depth * depth / (2.0 * std::numbers::pi * distance) * (*membranes[a].area_weight)(m) *
             (*membranes[b].area_weight)(n);
    };
  };
  pairs_->for_each(grid_, membranes, add(1.0));
  pairs_->for_each_mirrored(grid_, membranes, add(0.5));
  if (!parameters_.walls) return sum;
  for (const RepelledMembrane& membrane : membranes)
    for_each_marker_near_a_wall(grid_, range, *membrane.positions, [&](Eigen::Index m, int, double, double depth) {
      sum += (*membrane.area_weight)(m)*strength * range / 3.0 * depth * depth * depth;
    });
  return sum;
}

}  // namespace vesiflow::coupling
