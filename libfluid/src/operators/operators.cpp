// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/operators.h"

#include <algorithm>
#include <cmath>

#include "grid/check_grid.h"
#include "grid/planes.h"
#include "operators/cell_divergence.h"
#include "operators/convection_row.h"

namespace vesiflow::fluid {
void gradient(const Field<Cell>& p, FaceVector& g) {
  check_grid("gradient", "g", g, p.grid());
  const auto fields = g.points();
  const ConstView cells = p.points();
  for_each_plane(cells.extent, [&](int k) {
    for (int component = 0; component < 3; ++component) {
      const UnknownRange range = unknown_range(p.grid(), component);
      const double per_h = 1.0 / p.grid().spacing(component);
      const std::ptrdiff_t back = stride(cells, component);
      if (k < range.begin[2]) continue;
      for (int j = range.begin[1]; j < range.end[1]; ++j) {
        const double* here = cells.row(j, k);
        double* out = fields[component].row(j, k);
        for (int i = range.begin[0]; i < range.end[0]; ++i) out[i] = (here[i] - here[i - back]) * per_h;
      }
    }
  });
}

void divergence(const FaceVector& u, Field<Cell>& d) {
  check_grid("divergence", "u", u, d.grid());
  const CellDivergence cell_divergence(u);
  for_each_plane(d.extent(), [&](int k) {
    for (int j = 0; j < d.extent(1); ++j) {
      const double* x = u.x.row(j, k);
      const double* y = u.y.row(j, k);
      const double* z = u.z.row(j, k);
      double* out = d.row(j, k);
#pragma omp simd
      for (int i = 0; i < d.extent(0); ++i) out[i] = cell_divergence(x + i, y + i, z + i);
    }
  });
}

double max_divergence(const FaceVector& u, const Field<Cell>* source) {
  check_grid("max_divergence", "u", u, u.grid());
  if (source != nullptr) check_grid("max_divergence", "the source", *source, u.grid());
  const CellDivergence cell_divergence(u);
  const auto& n = u.grid().cells;
  return max_over_planes(n, [&](int k) {
    double largest = 0.0;
    for (int j = 0; j < n[1]; ++j) {
      const double* x = u.x.row(j, k);
      const double* y = u.y.row(j, k);
      const double* z = u.z.row(j, k);
      const double* s = source != nullptr ? source->row(j, k) : nullptr;
      for (int i = 0; i < n[0]; ++i)
        largest = std::max(largest, magnitude(cell_divergence(x + i, y + i, z + i) - (s != nullptr ? s[i] : 0.0)));
    }
    return largest;
  });
}

UnknownRange unknown_range(const Grid& grid, int component) {
  UnknownRange range{{0, 0, 0}, grid.cells};
  range.begin[component] = first_unknown(grid, face_centrings[component], component);
  return range;
}

void convection_row(const Grid& grid, const std::array<ConstView, 3>& u, int component, int j, int k, double* out) {
  // Along axis d: the neighbours of c, and the four velocities u_d whose pairs average to the points in
  // between. For d = c these are neighbours of c itself; else the faces of the two cells on either side of
  // c's face.
  struct Axis {
    const double *c_above, *c_below, *above_0, *above_1, *below_0, *below_1;
    double factor;
  };
  std::array<Axis, 3> axes{};
  const double* c = u[component].row(j, k);
  for (int d = 0; d < 3; ++d) {
    const std::ptrdiff_t c_step = stride(u[component], d);
    const std::ptrdiff_t d_step = stride(u[d], d);
    const double* above_0 = u[d].row(j, k) + d_step;
    const double* above_1 = above_0 - stride(u[d], component);
    axes[d] = {c + c_step, c - c_step, above_0, above_1, above_0 - d_step, above_1 - d_step, 0.25 / grid.spacing(d)};
  }
  const Axis x = axes[0], y = axes[1], z = axes[2];
  const auto flux_difference = [](const Axis& a, int i) {
    return a.factor * ((a.above_0[i] + a.above_1[i]) * a.c_above[i] - (a.below_0[i] + a.below_1[i]) * a.c_below[i]);
  };
  const UnknownRange range = unknown_range(grid, component);
#pragma omp simd
  for (int i = range.begin[0]; i < range.end[0]; ++i) {
    out[i] = flux_difference(x, i) + flux_difference(y, i) + flux_difference(z, i);
  }
}

void convection(const FaceVector& u, FaceVector& n) {
  check_grid("convection", "u", u, u.grid());
  check_grid("convection", "n", n, u.grid());
  const auto fields = u.points();
  const auto results = n.points();
  for_each_plane(u.grid().cells, [&](int k) {
    for (int component = 0; component < 3; ++component) {
      const UnknownRange range = unknown_range(u.grid(), component);
      for (int j = range.begin[1]; j < range.end[1]; ++j) {
        if (range.contains_row(j, k)) {
          convection_row(u.grid(), fields, component, j, k, results[component].row(j, k));
        }
      }
    }
  });
}

}  // namespace vesiflow::fluid
