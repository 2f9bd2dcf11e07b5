// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle {

// One reader for each format of read_triangle_mesh, which knows that the file is of this format.

TriangleMesh read_obj(const std::filesystem::path& path);
TriangleMesh read_off(const std::filesystem::path& path);
TriangleMesh read_ply(const std::filesystem::path& path);
TriangleMesh read_text_stl(const std::filesystem::path& path);
TriangleMesh read_binary_stl(const std::filesystem::path& path);

/// Whether the word is OFF with any of the prefixes ST, C, N, 4, n, in this order.
bool is_off_keyword(std::string_view word);

}  // namespace vesiflow::vesicle
