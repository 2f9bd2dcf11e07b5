// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "vesicle/export.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Triangles between vertices. Vertices and triangles are numbered from 0, here and in messages.
struct TriangleMesh {
  VectorField vertices;                            ///< shape (vertices, 3)
  Eigen::Array<int, Eigen::Dynamic, 3> triangles;  ///< shape (triangles, 3), rows into vertices
};

/// Checks that the mesh is one closed, oriented surface of the topology of the sphere. Whether it turns outward or
/// inward is not looked at, nor whether triangles cut through each other (check_no_crossings).
/// \throws std::domain_error that says what is wrong and where: fewer than 4 vertices, a vertex that is not finite, two
/// vertices at the same point, a vertex number out of range or twice in a triangle, a vertex of no triangle, an open
/// edge, an edge of more than two triangles, a triangle that turns the other way than its neighbours, a vertex where
/// the surface touches itself, more than one component, or a genus other than zero.
VESIFLOW_VESICLE_EXPORT void check_closed_genus_zero(const TriangleMesh& mesh);

/// Checks that no triangle cuts through another that has no vertex in common with it. Touching is no crossing.
/// \throws std::domain_error that names two that do, or a vertex number out of range.
VESIFLOW_VESICLE_EXPORT void check_no_crossings(const TriangleMesh& mesh);

/// Volume and centroid of what a closed mesh encloses.
struct EnclosedVolume {
  double volume = 0;                   ///< (1/6) sum det(a, b, c) over the triangles: > 0 when they turn outward
  Vector3 centroid = Vector3::Zero();  ///< of the enclosed volume
};
/// Volume (1/6) sum det(a, b, c) over the triangles of a closed mesh, > 0 when they turn outward (counterclockwise seen
/// from outside), and centroid of the enclosed volume.
/// \throws std::domain_error that names a vertex number out of range.
VESIFLOW_VESICLE_EXPORT EnclosedVolume enclosed_volume(const TriangleMesh& mesh);

}  // namespace vesiflow::vesicle
