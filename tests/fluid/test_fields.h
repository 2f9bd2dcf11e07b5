// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Fields for the tests of libfluid: random numbers with fixed seeds, sums, and differences.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "fluid/field.h"

namespace vesiflow::fluid::test {

template <class Function>
void for_each_point(const std::array<int, 3>& extent, Function&& visit) {
  for (int k = 0; k < extent[2]; ++k) {
    for (int j = 0; j < extent[1]; ++j) {
      for (int i = 0; i < extent[0]; ++i) visit(i, j, k);
    }
  }
}

inline void fill_random(View view, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for_each_point(view.extent, [&](int i, int j, int k) { view(i, j, k) = uniform(generator); });
}

// Random inside, zero on the walls.
inline FaceVector random_velocity(const Grid& grid, unsigned seed) {
  FaceVector u(grid);
  for (const View& component : u.unknowns()) fill_random(component, seed++);
  return u;
}

inline double dot(ConstView a, ConstView b) {
  double sum = 0.0;
  for_each_point(a.extent, [&](int i, int j, int k) { sum += a(i, j, k) * b(i, j, k); });
  return sum;
}

inline double dot(const FaceVector& a, const FaceVector& b) {
  return dot(a.x.unknowns(), b.x.unknowns()) + dot(a.y.unknowns(), b.y.unknowns()) +
         dot(a.z.unknowns(), b.z.unknowns());
}

inline double max_abs(ConstView a) {
  double largest = 0.0;
  for_each_point(a.extent, [&](int i, int j, int k) { largest = std::max(largest, std::abs(a(i, j, k))); });
  return largest;
}

inline double max_difference(ConstView a, ConstView b) {
  double largest = 0.0;
  for_each_point(a.extent,
                 [&](int i, int j, int k) { largest = std::max(largest, std::abs(a(i, j, k) - b(i, j, k))); });
  return largest;
}

inline double max_difference(const FaceVector& a, const FaceVector& b) {
  return std::max({max_difference(a.x.points(), b.x.points()), max_difference(a.y.points(), b.y.points()),
                   max_difference(a.z.points(), b.z.points())});
}

template <class Centring>
bool same_bits(const Field<Centring>& a, const Field<Centring>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

inline bool same_bits(const FaceVector& a, const FaceVector& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

}  // namespace vesiflow::fluid::test
