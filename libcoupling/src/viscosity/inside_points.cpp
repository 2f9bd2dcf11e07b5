// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/inside_points.h"

#include <cmath>

#include "transfer/roomy.h"
#include "viscosity/grid_places.h"

namespace vesiflow::coupling {
void InsidePoints::find(const GridBand& band, double spacing) {
  const double near = spacing * (1.0 + 1e-9);
  const auto& first = band.first();
  const auto& n = band.extent();
  reserve_with_room(runs_, static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]));  // of a convex body
  runs_.clear();
  for (int k = first[2]; k < first[2] + n[2]; ++k)
    for (int j = first[1]; j < first[1] + n[1]; ++j) {
      // From above: a body across a mirror plane fills the lower end of the box.
      bool inside = false;
      std::ptrdiff_t at = band.offset(first[0] + n[0] - 1, j, k);
      for (int i = first[0] + n[0] - 1; i >= first[0]; --i, --at) {
        const bool before = inside;
        if (std::abs(band.distance(at)) <= near) inside = band.is_inside(at);
        if (inside && !before) runs_.push_back({i, i + 1, j, k});
        if (inside) runs_.back().first = i;
      }
    }
}

void InsidePoints::multiply(double factor, const fluid::Grid& grid, const fluid::View& points) const {
  for (const Run& run : runs_)
    for (int i = run.first; i < run.last; ++i)
      for_places({i, run.j, run.k}, grid, points.extent, [&](int x, int y, int z) { points(x, y, z) *= factor; });
}

}  // namespace vesiflow::coupling
