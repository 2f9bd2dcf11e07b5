// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "transfer/fine_surface.h"
#include "transfer/grid_box.h"

namespace vesiflow::coupling {

/// The nearest node of a surface's mesh to each point of a box that is near the surface.
class NearestNodes {
 public:
  /// Fewest points in a row of a box.
  static constexpr int smallest_row = 8;

  /// Looks for the nodes of all points within `reach` of one; of points beyond it may find one or not. Only
  /// the surface's sparse_nodes() are looked at. Nothing allocates but for a larger box.
  void search(const FineSurface& surface, const GridBox& box, double reach);

  /// Of each point of the box: squared distance of its nearest node and that node, to compare with limits.
  using Key = std::uint32_t;
  const std::vector<Key>& keys() const { return keys_; }
  /// Keys below it are those of points with a node within a distance up to the reach.
  Key limit(double distance) const;
  /// Keys below it are those of points that have a node.
  static constexpr Key limit() { return std::numeric_limits<Key>::max(); }

  /// The node nearest to the point at that offset in the box, which has one.
  FineSurface::Node node(std::ptrdiff_t at) const {
    const auto number = static_cast<int>(keys_[static_cast<std::size_t>(at)] & ((1U << node_bits_) - 1U));
    return {number / longitudes_, number % longitudes_};
  }

 private:
  void search_planes(const FineSurface& surface, const GridBox& box, int first, int last);

  // Squared distance in units in the upper bits, node in the lower: so the nearest is the smallest, and of several at
  // the same distance the one of the lowest number, in whatever order they come.
  std::vector<Key> keys_;
  int node_bits_ = 1;
  int longitudes_ = 1;
  Key most_units_ = 1;
  double reach_ = 0.0, units_ = 0.0;  // units per squared distance
};

}  // namespace vesiflow::coupling
