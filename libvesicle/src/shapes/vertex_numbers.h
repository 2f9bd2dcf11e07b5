// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {

/// Throws std::domain_error that names the triangle and the number unless all triangles are between vertices of the mesh.
void check_vertex_numbers(const TriangleMesh& mesh);

}  // namespace vesiflow::vesicle
