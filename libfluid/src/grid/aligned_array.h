// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays that begin on a cache line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace vesiflow::fluid {

constexpr std::align_val_t cache_line{64};

struct AlignedRelease {
  void operator()(double* memory) const { ::operator delete(memory, cache_line); }
};
using AlignedArray = std::unique_ptr<double[], AlignedRelease>;

// count zeros.
inline AlignedArray allocate_aligned(std::size_t count) {
  double* memory = static_cast<double*>(::operator new(sizeof(double) * count, cache_line));
  std::fill_n(memory, count, 0.0);
  return AlignedArray(memory);
}

// Stride for rows of that many numbers: whole cache lines, and an odd number of them, as rows a power of two apart
// would compete for the same cache sets.
inline std::ptrdiff_t padded(int extent) {
  return 8 * ((extent + 7) / 8 | 1);
}

}  // namespace vesiflow::fluid
