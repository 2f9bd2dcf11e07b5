// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "fluid/grid.h"

namespace vesiflow::coupling {

/// Where along an axis a field holds a point, ghosts included: across a periodic axis the last face is the first, and
/// ghosts are points of the other end. Beyond a mirror plane ghosts are the mirror images of points, which of a component
/// along the plane have the same value; that of the component normal to it, which no operator reads, is left out.
struct GridPlaces {
  std::array<int, 3> index{};
  int count = 0;

  /// \param extent of the field along the axis. \param point may run on across a periodic axis; beyond a mirror plane the
  /// field holds none.
  GridPlaces(int point, int axis, const fluid::Grid& grid, int extent) {
    const auto add = [&](int place) {
      if (place >= -1 && place <= extent) index[static_cast<std::size_t>(count++)] = place;
    };
    const int cells = grid.cells[static_cast<std::size_t>(axis)];
    if (grid.mirror[static_cast<std::size_t>(axis)]) {
      if (point >= 0) add(point);
      if (point == 0 && extent == cells) add(-1);
      return;
    }
    if (!grid.periodic[static_cast<std::size_t>(axis)]) {
      add(point);
      return;
    }
    const int wrapped = ((point % cells) + cells) % cells;
    for (const int place : {wrapped - cells, wrapped, wrapped + cells}) add(place);
  }

  const int* begin() const { return index.data(); }
  const int* end() const { return index.data() + count; }
};

/// Calls work(i, j, k) for all places where a field of the grid holds a point.
template <class Work>
void for_places(const std::array<int, 3>& point, const fluid::Grid& grid, const std::array<int, 3>& extent,
                const Work& work) {
  for (const int k : GridPlaces(point[2], 2, grid, extent[2]))
    for (const int j : GridPlaces(point[1], 1, grid, extent[1]))
      for (const int i : GridPlaces(point[0], 0, grid, extent[0])) work(i, j, k);
}

}  // namespace vesiflow::coupling
