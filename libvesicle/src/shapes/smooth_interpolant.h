// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vesicle/mesh_fit.h"
#include "vesicle/triangle_mesh.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// What a closed triangle mesh says about the smooth surface through its vertices. Normals at the vertices are those of N. Max,
/// J. Graph. Tools 4 (1999) 1, right on spheres; the middle of an edge is that of the cubic of A. Vlachos, J. Peters,
/// C. Boyd and J. Mitchell (curved PN triangles, Proc. I3D (2001) 159) which leaves both ends across their normals.
struct SmoothInterpolant {
  struct Edge {
    int from, to;
    Vector3 middle, normal;
    double sagitta;  ///< distance of `middle` from the middle of the chord
  };
  std::vector<Edge> edges;
  AreaAndVolume triangles;
  /// Richardson's extrapolation from the triangles and those with a fourth of their size through the middles.
  AreaAndVolume smooth;

  /// The mesh must be closed and turn outward.
  explicit SmoothInterpolant(const TriangleMesh& mesh);
};

}  // namespace vesiflow::vesicle
