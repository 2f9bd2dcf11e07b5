// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/inside_points.h"

#include <array>
#include <cmath>

namespace vesiflow::coupling {
namespace {

/// Where along an axis a field holds a point, ghosts included.
struct Places {
  std::array<int, 3> index{};
  int count = 0;

  const int* begin() const { return index.data(); }
  const int* end() const { return index.data() + count; }
};

Places places_of(int index, int axis, const fluid::Grid& grid, int extent) {
  Places places;
  const auto add = [&](int place) {
    if (place >= -1 && place <= extent) places.index[static_cast<std::size_t>(places.count++)] = place;
  };
  if (!grid.periodic[static_cast<std::size_t>(axis)]) {
    add(index);
    return places;
  }
  const int cells = grid.cells[static_cast<std::size_t>(axis)];
  const int wrapped = ((index % cells) + cells) % cells;
  for (const int place : {wrapped - cells, wrapped, wrapped + cells}) add(place);
  return places;
}

}  // namespace

void InsidePoints::find(const GridBand& band, double spacing) {
  runs_.clear();
  const double near = spacing * (1.0 + 1e-9);
  const auto& first = band.first();
  const auto& n = band.extent();
  std::ptrdiff_t at = 0;
  for (int k = first[2]; k < first[2] + n[2]; ++k)
    for (int j = first[1]; j < first[1] + n[1]; ++j) {
      bool inside = false;
      for (int i = first[0]; i < first[0] + n[0]; ++i, ++at) {
        const bool before = inside;
        if (std::abs(band.distance(at)) <= near) inside = band.is_inside(at);
        if (inside && !before) runs_.push_back({i, i, j, k});
        if (inside) runs_.back().last = i + 1;
      }
    }
}

void InsidePoints::multiply(double factor, const fluid::Grid& grid, const fluid::View& points) const {
  for (const Run& run : runs_)
    for (const int k : places_of(run.k, 2, grid, points.extent[2]))
      for (const int j : places_of(run.j, 1, grid, points.extent[1]))
        for (int i = run.first; i < run.last; ++i)
          for (const int place : places_of(i, 0, grid, points.extent[0])) points(place, j, k) *= factor;
}

}  // namespace vesiflow::coupling
