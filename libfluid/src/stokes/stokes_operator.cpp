// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stokes/stokes_operator.h"
#include "grid/planes.h"

namespace vesiflow::fluid {

void add_gradient(const Grid& grid, GhostedBlocks& p, Blocks y) {
  p.set_ghosts();
  const ConstView cells = std::as_const(p).points()[0];
  for (int component = 0; component < 3; ++component) {
    const View& to = y[component];
    const double per_h = 1.0 / grid.spacing(component);
    const int first = first_unknown(grid, face_centrings[component], component);
    const std::ptrdiff_t back = component == 0 ? 1 : component == 1 ? cells.row_stride : cells.plane_stride;
    for_each_plane(to.extent, [&](int k) {
      for (int j = 0; j < to.extent[1]; ++j) {
        const double* above = cells.row(j, k) + first * back;
        const double* below = above - back;
        double* out = to.row(j, k);
#pragma omp simd
        for (int i = 0; i < to.extent[0]; ++i) out[i] += (above[i] - below[i]) * per_h;
      }
    });
  }
}

void negative_divergence(const Grid& grid, ConstBlocks u_points, View d) {
  const ConstView &ux = u_points[0], &uy = u_points[1], &uz = u_points[2];
  const double x_per_h = 1.0 / grid.spacing(0);
  const double y_per_h = 1.0 / grid.spacing(1);
  const double z_per_h = 1.0 / grid.spacing(2);
  for_each_plane(d.extent, [&](int k) {
    for (int j = 0; j < d.extent[1]; ++j) {
      const double* x = ux.row(j, k);
      const double* south = uy.row(j, k);
      const double* north = uy.row(j + 1, k);
      const double* below = uz.row(j, k);
      const double* above = uz.row(j, k + 1);
      double* out = d.row(j, k);
#pragma omp simd
      for (int i = 0; i < d.extent[0]; ++i) {
        out[i] = (x[i] - x[i + 1]) * x_per_h + (south[i] - north[i]) * y_per_h + (below[i] - above[i]) * z_per_h;
      }
    }
  });
}

}  // namespace vesiflow::fluid
