// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace vesiflow::run {

/// Bytes as text (RFC 4648, with padding).
std::string base64(std::span<const std::uint8_t> bytes);

/// How long that text is.
inline std::size_t base64_size(std::size_t bytes) {
  return 4 * ((bytes + 2) / 3);
}

}  // namespace vesiflow::run
