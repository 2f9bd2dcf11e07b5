// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/resampling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/check_grid.h"
#include "grid/planes.h"

namespace vesiflow::fluid {
namespace {

// Where a point of the new grid is among those of the old one, along an axis: between first and first + 1.
struct PlaceBetween {
  int first = 0;
  double fraction = 0.0;
  bool inside = false;
};

std::vector<PlaceBetween> places(const Grid& from, const Grid& to, Centring centring, int axis) {
  constexpr double round_off = 1e-9;  // of a cell
  const double offset = is_face_normal(centring, axis) ? 0.0 : 0.5;
  const int last = point_extent(from, centring)[axis] - 1;
  std::vector<PlaceBetween> all(static_cast<std::size_t>(point_extent(to, centring)[axis]));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double position = to.lower[axis] + (static_cast<double>(i) + offset) * to.spacing(axis);
    const double cells = (position - from.lower[axis]) / from.spacing(axis);
    const double index = cells - offset;
    // From the ghost before the first point to that after the last.
    const int first = std::clamp(static_cast<int>(std::floor(index + round_off)), -1, last);
    const double fraction = index - first;
    all[i] = {first, std::abs(fraction) < round_off ? 0.0 : fraction,
              cells > -round_off && cells < from.cells[axis] + round_off};
  }
  return all;
}

template <class FieldType>
void interpolate(const FieldType& from, FieldType& to) {
  std::array<std::vector<PlaceBetween>, 3> at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = places(from.grid(), to.grid(), FieldType::centring, axis);
  for_each_plane(to.extent(), [&](int k) {
    const PlaceBetween& z = at[2][k];
    if (!z.inside) return;
    for (int j = 0; j < to.extent(1); ++j) {
      const PlaceBetween& y = at[1][j];
      if (!y.inside) continue;
      // A neighbour of no weight may be beyond the ghosts.
      const int next_y = y.first + (y.fraction > 0.0 ? 1 : 0), next_z = z.first + (z.fraction > 0.0 ? 1 : 0);
      const double* const rows[] = {from.row(y.first, z.first), from.row(next_y, z.first), from.row(y.first, next_z),
                                    from.row(next_y, next_z)};
      for (int i = 0; i < to.extent(0); ++i) {
        const PlaceBetween& x = at[0][i];
        if (!x.inside) continue;
        const int next_x = x.first + (x.fraction > 0.0 ? 1 : 0);
        const auto along_x = [&](int row) { return std::lerp(rows[row][x.first], rows[row][next_x], x.fraction); };
        to(i, j, k) = std::lerp(std::lerp(along_x(0), along_x(1), y.fraction),
                                std::lerp(along_x(2), along_x(3), y.fraction), z.fraction);
      }
    }
  });
}

}  // namespace

void resample(const Field<Cell>& from, Field<Cell>& to) {
  interpolate(from, to);
}

void resample(const FaceVector& from, FaceVector& to) {
  check_grid("resample", "from", from, from.grid());
  check_grid("resample", "to", to, to.grid());
  interpolate(from.x, to.x);
  interpolate(from.y, to.y);
  interpolate(from.z, to.z);
}

}  // namespace vesiflow::fluid
