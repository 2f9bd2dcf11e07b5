// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_source.h"
#include "vesicle/coefficients.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface_geometry.h"

/// Curvatures at the nodes of one grid of surfaces given by the coefficients of X, of more degrees than the grid can
/// sample if need be. H and K are exact values of the expansion; Lap_Gamma H is taken in Cartesian form (H and its surface
/// gradient, Eq. (11), on a grid with as many latitudes as degrees; Eq. (12) at the nodes).
class ExpansionGeometry {
 public:
  ExpansionGeometry(int degrees, const vesiflow::vesicle::SphereGrid& nodes);

  /// Positions of at least `degrees` degrees; the degrees above are left out.
  /// @throws std::domain_error if the surface is degenerate.
  Curvatures at_nodes(const vesiflow::vesicle::Coefficients& positions);

 private:
  vesiflow::vesicle::SphericalHarmonics at_nodes_, on_fine_;
  vesiflow::vesicle::SurfaceGeometry node_geometry_, fine_geometry_;
};

/// Coefficients with all degrees n < latitudes of positions sampled on a grid of that many latitudes. The last degrees are
/// set to zero as far as they hold nothing but the rounding of the positions, which the four derivatives of Lap H would
/// multiply by the fourth power of the degree.
vesiflow::vesicle::Coefficients expansion_of(const SurfaceSource& source, int latitudes);
