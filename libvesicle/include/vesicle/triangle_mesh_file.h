// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "vesicle/export.h"
#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {

/// Whether the file is a triangle mesh: by its first bytes where they say what it is, of the formats below or of
/// another that this library can only name, and by the ending .obj, .off, .ply or .stl of its name where they do not.
/// \throws std::runtime_error if the file cannot be read.
VESIFLOW_VESICLE_EXPORT bool is_triangle_mesh_file(const std::filesystem::path& path);

/// Reads a mesh. What the file holds decides how, whatever its name:
/// - Wavefront OBJ: the `v` and `f` lines, with v/vt/vn corners, numbers relative to the end and lines continued after
///   a backslash; others are skipped;
/// - OFF of Geomview as text, with any of the prefixes ST, C, N, 4, n (of three dimensions): texture coordinates,
///   colours and normals are skipped, x y z of 4OFF is divided by its w;
/// - STL, text or binary: corners at the same point are one vertex, triangles with a corner twice are left out;
/// - PLY, ascii or binary in either order of bytes: x, y, z of the vertices and vertex_indices (or vertex_index) of the
///   faces; other properties and elements are skipped.
/// Faces of more than three corners are split into fans from their first corner. In text, `#` starts a comment and a
/// byte order mark of UTF-8 is skipped. The topology is not looked at: see check_closed_genus_zero.
/// \throws std::runtime_error with file and line, or the number of the face in binary files, for anything else: other
/// formats, by their name if it is known; text in UTF-16; a number that is not finite, a face of fewer than three
/// corners, a corner that is no vertex, in OFF and PLY more or less than was counted; and if the file cannot be read.
VESIFLOW_VESICLE_EXPORT TriangleMesh read_triangle_mesh(const std::filesystem::path& path);

}  // namespace vesiflow::vesicle
