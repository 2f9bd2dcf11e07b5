// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "expansion_geometry.h"

#include <limits>

using namespace vesiflow::vesicle;

namespace {

// Rounding spreads evenly over the coefficients: each has the share 1/size of its energy.
void drop_rounding(Coefficients& positions, const SphereGrid& grid) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const int degrees = positions.degrees();
  const double share = rounding * rounding * positions.energy(0, degrees) / static_cast<double>(grid.size());
  int kept = degrees;
  while (kept > 1 && positions.energy(kept - 1, kept) < share * (2 * kept - 1)) --kept;
  positions.truncate(kept);
}

}  // namespace

ExpansionGeometry::ExpansionGeometry(int degrees, const SphereGrid& nodes)
    : at_nodes_(degrees, nodes),
      on_fine_(degrees, SphereGrid(degrees)),
      node_geometry_(nodes),
      fine_geometry_(on_fine_.grid()) {}

Curvatures ExpansionGeometry::at_nodes(const Coefficients& positions) {
  node_geometry_.update(at_nodes_, positions);
  fine_geometry_.update(on_fine_, positions);

  const Eigen::Index fine = on_fine_.grid().size(), nodes = at_nodes_.grid().size();
  Coefficients coefficients;
  on_fine_.analysis(fine_geometry_.mean_curvature(), coefficients);
  ScalarField theta(fine), phi(fine);
  on_fine_.gradient(coefficients, theta, phi);
  VectorField gradient(fine, 3);
  for (int k = 0; k < 3; ++k)
    gradient.col(k) = theta * fine_geometry_.dual_theta().col(k) + phi * fine_geometry_.dual_phi().col(k);
  on_fine_.analysis(gradient, coefficients);
  VectorField gradient_theta(nodes, 3), gradient_phi(nodes, 3);
  at_nodes_.gradient(coefficients, gradient_theta, gradient_phi);
  return {
      .mean = node_geometry_.mean_curvature(),
      .gaussian = node_geometry_.gaussian_curvature(),
      .laplacian =
          (gradient_theta * node_geometry_.dual_theta() + gradient_phi * node_geometry_.dual_phi()).rowwise().sum()};
}

Coefficients expansion_of(const SurfaceSource& source, int latitudes) {
  const SphereGrid grid(latitudes);
  Coefficients coefficients;
  SphericalHarmonics(latitudes, grid).analysis(source.sample(grid), coefficients);
  drop_rounding(coefficients, grid);
  return coefficients;
}
