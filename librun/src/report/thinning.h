// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace vesiflow::run {

/// Which of `count` to keep where `most` are wanted: the first, the last, and others evenly between; all if they are not more.
inline std::vector<std::size_t> evenly_chosen(std::size_t count, std::size_t most) {
  std::vector<std::size_t> kept;
  if (count <= most || most < 2) {
    for (std::size_t i = 0; i < count && (count <= most || i < most); ++i)
      kept.push_back(count <= most ? i : count - 1);
    return kept;
  }
  for (std::size_t i = 0; i < most; ++i) kept.push_back((i * (count - 1) + (most - 1) / 2) / (most - 1));
  return kept;
}

}  // namespace vesiflow::run
