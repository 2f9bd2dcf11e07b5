// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/surface.h"

namespace vesiflow::vesicle {

/// How well a mesh resolves its surface. Stretches are those of the map from the unit sphere to the surface; all three
/// numbers do not depend on how the sphere of parameters is turned.
struct MeshQuality {
  /// max over the markers of the larger over the smaller principal stretch, >= 1: the square root of the ratio of the
  /// eigenvalues of the metric (E, F; F, G) relative to the unit sphere's (1, 0; 0, sin^2 theta). 1 for a conformal
  /// map; a spheroid X = (a sin cos, a sin sin, c cos) has c/a or a/c at its equator.
  double aspect_ratio = 1;
  /// Largest over smallest area element per area of the unit sphere, >= 1.
  double area_ratio = 1;
  /// Share of the position's energy (degrees n >= 1) in the degrees n >= 2N/3, see spectrum_tail().
  double spectrum_tail = 0;
};

/// Quality of the mesh of a surface at its last geometry.
VESIFLOW_VESICLE_EXPORT MeshQuality mesh_quality(const Surface& surface);

}  // namespace vesiflow::vesicle
