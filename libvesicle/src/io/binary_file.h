// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace vesiflow::vesicle {

/// The file, open for reading. One that is no file of a disk (a folder, a pipe, a device) is refused: it could not be read
/// twice, and may never end.
/// @throws std::runtime_error if it cannot be opened.
std::ifstream opened(const std::filesystem::path& path);

/// @throws std::runtime_error if the file cannot be read.
std::string contents_of(const std::filesystem::path& path);

/// Throws std::runtime_error "path: what".
[[noreturn]] void fail_in(const std::filesystem::path& path, const std::string& what);

template <class Number>
Number from_bytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> copy{};
  std::copy_n(bytes, sizeof(Number), copy.begin());
  if (order != std::endian::native) std::ranges::reverse(copy);
  return std::bit_cast<Number>(copy);
}

}  // namespace vesiflow::vesicle
