// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

// GCC warns that passing vectors has another binary interface without AVX. No vector leaves a source file that
// includes this, so the warning is off for the rest of it.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vesiflow::vesicle {

/// Vectors of doubles: the vector extension of GCC and Clang, which any target has.
template <int count>
using VectorOf __attribute__((vector_size(count * sizeof(double)))) = double;

/// What folding and unfolding work on: four rings.
using Lanes = VectorOf<4>;
inline constexpr int lane_count = 4;

template <class Vector>
Vector load(const double* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

template <class Vector>
void store(double* to, const Vector& v) {
  std::memcpy(to, &v, sizeof v);
}

/// Four complex numbers by parts.
struct ComplexLanes {
  Lanes real, imaginary;
};

// Two exchanges between the halves of vectors and two within: GCC makes six of the direct permutations.
inline ComplexLanes load_complex(const double* from) {
  const Lanes a = load<Lanes>(from), b = load<Lanes>(from + lane_count);
  const Lanes even = __builtin_shufflevector(a, b, 0, 1, 4, 5), odd = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  return {__builtin_shufflevector(even, odd, 0, 4, 2, 6), __builtin_shufflevector(even, odd, 1, 5, 3, 7)};
}

template <bool add = false>
inline void store_complex(double* to, const Lanes& real, const Lanes& imaginary) {
  const Lanes even = __builtin_shufflevector(real, imaginary, 0, 4, 2, 6);
  const Lanes odd = __builtin_shufflevector(real, imaginary, 1, 5, 3, 7);
  Lanes a = __builtin_shufflevector(even, odd, 0, 1, 4, 5), b = __builtin_shufflevector(even, odd, 2, 3, 6, 7);
  if constexpr (add) {
    a += load<Lanes>(to);
    b += load<Lanes>(to + lane_count);
  }
  store(to, a);
  store(to + lane_count, b);
}

/// Zeros that begin on a cache line: the bits and the speed of a program must not hang on where memory was found.
struct AlignedRelease {
  template <class Value>
  void operator()(Value* memory) const {
    ::operator delete (memory, std::align_val_t{64});
  }
};
template <class Value>
using AlignedArray = std::unique_ptr<Value[], AlignedRelease>;

template <class Value>
AlignedArray<Value> allocate_aligned(std::size_t count) {
  auto* memory = static_cast<Value*>(::operator new (sizeof(Value) * count, std::align_val_t{64}));
  std::uninitialized_fill_n(memory, count, Value{});
  return AlignedArray<Value>(memory);
}

}  // namespace vesiflow::vesicle
