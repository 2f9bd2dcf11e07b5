// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors of four doubles (the vector extension of GCC and Clang, which any target has), and blocks of lines
// that are transformed side by side.
#pragma once

#include <array>
#include <cstring>
#include <type_traits>

namespace vesiflow::fluid {

// 32 bytes of numbers, the widest vector that every processor with AVX has. As complex numbers real and imaginary parts
// alternate.
using Vector4 = double __attribute__((vector_size(4 * sizeof(double))));
using Single8 = float __attribute__((vector_size(8 * sizeof(float))));
using Vector8 = double __attribute__((vector_size(8 * sizeof(double))));  // what Single8 is converted from and to

template <class Scalar>
using Pack = std::conditional_t<std::is_same_v<Scalar, double>, Vector4, Single8>;
// Numbers in a Pack.
template <class Scalar>
constexpr int pack = static_cast<int>(32 / sizeof(Scalar));

// GCC warns that passing vectors has another binary interface without AVX. No vector leaves a source file that
// includes this, so the warning is off for the rest of it.
#pragma GCC diagnostic ignored "-Wpsabi"

template <class Scalar>
Pack<Scalar> load_pack(const Scalar* from) {
  Pack<Scalar> v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

template <class Scalar>
void store_pack(Scalar* to, const std::type_identity_t<Pack<Scalar>>& v) {
  std::memcpy(to, &v, sizeof v);
}

// As many numbers as a Pack<Scalar> has, rounded to Scalar where they are double.
template <class Scalar, class From>
Pack<Scalar> load_rounded(const From* from) {
  if constexpr (std::is_same_v<Scalar, From>) {
    return load_pack(from);
  } else {
    Vector8 v;
    std::memcpy(&v, from, sizeof v);
    return __builtin_convertvector(v, Pack<Scalar>);
  }
}

// v, or *base + v if base is not null, in the numbers of what it is written to.
template <class To>
void store_widened(To* to, const Pack<To>& v, const To* base) {
  store_pack(to, base != nullptr ? load_pack(base) + v : v);
}
inline void store_widened(double* to, const Single8& v, const double* base) {
  Vector8 wide = __builtin_convertvector(v, Vector8);
  if (base != nullptr) {
    Vector8 sum;
    std::memcpy(&sum, base, sizeof sum);
    wide += sum;
  }
  std::memcpy(to, &wide, sizeof wide);
}

// i times the complex numbers.
inline Vector4 times_i(const Vector4& v) {
  return __builtin_shufflevector(v, v, 1, 0, 3, 2) * Vector4{-1.0, 1.0, -1.0, 1.0};
}
inline Single8 times_i(const Single8& v) {
  return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6) * Single8{-1, 1, -1, 1, -1, 1, -1, 1};
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

inline void transpose(std::array<Single8, 8>& v) {
  for (int r = 0; r < 8; r += 2) {
    const Single8 a = v[r], b = v[r + 1];
    v[r] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    v[r + 1] = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (const int r : {0, 1, 4, 5}) {
    const Single8 a = v[r], b = v[r + 2];
    v[r] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    v[r + 2] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int r = 0; r < 4; ++r) {
    const Single8 a = v[r], b = v[r + 4];
    v[r] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
    v[r + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// A block holds this many lines: a cache line, four complex numbers or eight single ones.
template <class Scalar>
constexpr int lanes = static_cast<int>(64 / sizeof(Scalar));

}  // namespace vesiflow::fluid
