// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "vesicle/coefficients.h"
#include "vesicle/export.h"

namespace vesiflow::vesicle {

/// Largest degree that a file may name.
inline constexpr int largest_file_degree = 512;

/// Reads a text file of the coefficients of a surface X = (x, y, z), three fields. It has one pair of degree n and
/// order m a line,
///
///     n m re_x im_x re_y im_y re_z im_z
///
/// in the convention of SphericalHarmonics: fully normalised, no Condon-Shortley phase, orders 0 <= m <= n (the
/// others follow because X is real). `#` starts a comment; lines come in any order and those left out are zero.
/// The surface has as many degrees as the largest n that is named needs.
/// \throws std::runtime_error with file and line, the value and what is allowed: a line that has not 8 numbers, n
/// outside [0, 512], m outside [0, n], a number that is not finite, an imaginary part other than 0 of order 0, a pair
/// (n, m) given twice, or no line at all; and if the file cannot be read.
VESIFLOW_VESICLE_EXPORT Coefficients read_surface_coefficients(const std::filesystem::path& path);

/// Writes a file for read_surface_coefficients(): every coefficient with 17 digits, so that it reads back to the same
/// bits.
/// \throws std::invalid_argument unless there are three fields, at most 513 degrees and finite values.
/// \throws std::runtime_error if the file cannot be written.
VESIFLOW_VESICLE_EXPORT void write_surface_coefficients(const std::filesystem::path& path,
                                                        const Coefficients& coefficients);

}  // namespace vesiflow::vesicle
