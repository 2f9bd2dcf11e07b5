// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors of four doubles (the vector extension of GCC and Clang, which any target has), and blocks of lines
// that are transformed side by side.
#pragma once

#include <array>
#include <cstring>

namespace vesiflow::fluid {

// As complex numbers: two of them, real and imaginary parts alternating.
using Vector4 = double __attribute__((vector_size(4 * sizeof(double))));

// GCC warns that passing vectors has another binary interface without AVX. No vector leaves a source file that
// includes this, so the warning is off for the rest of it.
#pragma GCC diagnostic ignored "-Wpsabi"

inline Vector4 load4(const double* from) {
  Vector4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

inline void store4(double* to, const Vector4& v) {
  std::memcpy(to, &v, sizeof v);
}

// i times both complex numbers.
inline Vector4 times_i(const Vector4& v) {
  return __builtin_shufflevector(v, v, 1, 0, 3, 2) * Vector4{-1.0, 1.0, -1.0, 1.0};
}

// Rows become columns.
inline void transpose(std::array<Vector4, 4>& v) {
  const Vector4 a = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const Vector4 b = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Vector4 c = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const Vector4 d = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  v[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  v[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  v[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// A block holds this many lines: a cache line, four complex numbers.
constexpr int lanes = 8;

}  // namespace vesiflow::fluid
