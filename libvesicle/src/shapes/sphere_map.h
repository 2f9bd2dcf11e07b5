// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/triangle_mesh.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// A one-to-one map of a closed triangle mesh of genus zero to the unit sphere: a unit vector for each vertex, shape
/// (vertices, 3), such that every triangle det(y_a, y_b, y_c) > 0 and the triangles cover the sphere once.
///
/// The mesh without one triangle is embedded in the plane by W. T. Tutte, Proc. London Math. Soc. 13 (1963) 743, which
/// cannot fold, and goes to the sphere by stereographic projection. From there the map moves down the energy MapEnergy of
/// its stretches, without folding, so that it neither crowds vertices nor shears triangles more than the shape asks for.
///
/// The mesh must have passed check_closed_genus_zero and turn outward.
/// @throws std::domain_error if no map without folds is found.
VectorField sphere_map(const TriangleMesh& mesh);

/// Whether every triangle det(y_a, y_b, y_c) of the map is > 0.
bool is_one_to_one(const TriangleMesh& mesh, const VectorField& map);

}  // namespace vesiflow::vesicle
