// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The curvatures of a surface of one's own: a dumbbell.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "vesicle/surface.h"

int main() {
  using namespace vesiflow::vesicle;
  Surface surface(48);
  const SphereGrid& grid = surface.grid();

  VectorField positions(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j) {
    const double cosine = grid.cos_colatitude()[j], sine = grid.sin_colatitude()[j];
    const double radius = 0.6 + 0.5 * cosine * cosine;
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double longitude = grid.longitude(i);
      positions.row(grid.index(i, j)) << radius * sine * std::cos(longitude), radius * sine * std::sin(longitude),
          radius * cosine;
    }
  }
  surface.update(positions);

  std::printf("colatitude  mean curvature  Gaussian curvature\n");
  for (int j = 0; j < grid.latitudes(); j += 4) {
    const auto marker = grid.index(0, j);
    std::printf("%10.4f  %14.6f  %18.6f\n", grid.colatitude()[j], surface.mean_curvature()[marker],
                surface.gaussian_curvature()[marker]);
  }
  const double gauss_bonnet = surface.integral(surface.gaussian_curvature()) / (4 * std::numbers::pi) - 1;
  std::printf("area %.10f, volume %.10f, int K dA / 4 pi - 1 = %.1e\n", surface.area(), surface.volume(), gauss_bonnet);
  return std::abs(gauss_bonnet) < 1e-9 ? 0 : 1;
}
