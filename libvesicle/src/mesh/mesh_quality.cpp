// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vesicle/spectrum.h"

namespace vesiflow::vesicle {

MeshQuality mesh_quality(const Surface& surface) {
  const SphereGrid& grid = surface.grid();
  const VectorField& theta = surface.tangent_theta();
  const VectorField& phi = surface.tangent_phi();
  double aspect = 1, smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (int j = 0; j < grid.latitudes(); ++j) {
    const double sine = grid.sin_colatitude()[j];
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index k = grid.index(i, j);
      // Principal stretches s1 >= s2 from their product and the sum of their squares.
      const double product = surface.area_element()[k] / sine;
      const double squares = theta.row(k).square().sum() + phi.row(k).square().sum() / (sine * sine);
      const double ratio = std::max(1.0, squares / (2 * product));  // (s1/s2 + s2/s1)/2
      aspect = std::max(aspect, ratio + std::sqrt((ratio - 1) * (ratio + 1)));
      smallest = std::min(smallest, product);
      largest = std::max(largest, product);
    }
  }
  return {aspect, largest / smallest, spectrum_tail(surface)};
}

}  // namespace vesiflow::vesicle
