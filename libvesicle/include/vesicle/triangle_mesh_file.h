#pragma once

#include <filesystem>

#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {

/// Whether the name ends in .obj or .off, in any case of letters.
bool is_triangle_mesh_name(const std::filesystem::path& path);

/// Reads a mesh from a text file, by the ending of its name:
/// - .obj (Wavefront): the `v` and `f` lines, with v/vt/vn corners and numbers relative to the end; others are skipped;
/// - .off: `OFF`, the three counts, vertices, faces; colours after the corners of a face are skipped.
/// Faces of more than three corners are split into fans from their first corner. `#` starts a comment.
/// The topology is not looked at: see check_closed_genus_zero.
/// @throws std::runtime_error with file and line for anything else, a number that is not finite, a face of fewer than
/// three corners, a corner that is no vertex or, in .off, more lines than were counted; and if the file cannot be read or its name ends otherwise.
TriangleMesh read_triangle_mesh(const std::filesystem::path& path);

}  // namespace vesiflow::vesicle
