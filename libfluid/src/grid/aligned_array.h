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
  void operator()(void* memory) const { ::operator delete(memory, cache_line); }
};
template <class Scalar>
using AlignedArrayOf = std::unique_ptr<Scalar[], AlignedRelease>;
using AlignedArray = AlignedArrayOf<double>;

// count zeros.
template <class Scalar = double>
AlignedArrayOf<Scalar> allocate_aligned(std::size_t count) {
  Scalar* memory = static_cast<Scalar*>(::operator new(sizeof(Scalar) * count, cache_line));
  std::fill_n(memory, count, Scalar(0));
  return AlignedArrayOf<Scalar>(memory);
}

// Stride for rows of that many numbers: whole cache lines, and an odd number of them, as rows a power of two apart
// would compete for the same cache sets.
template <class Scalar = double>
std::ptrdiff_t padded(int extent) {
  constexpr int line = static_cast<int>(64 / sizeof(Scalar));
  return line * ((extent + line - 1) / line | 1);
}

}  // namespace vesiflow::fluid
