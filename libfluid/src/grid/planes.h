// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Loops over the z planes of arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "short_waits.h"

namespace vesiflow::fluid {

// From a number to the next along an axis of a view.
template <class View>
std::ptrdiff_t stride(const View& view, int axis) {
  return axis == 0 ? 1 : axis == 1 ? view.row_stride : view.plane_stride;
}

// Below this many numbers a loop takes less time than waking another thread (about 10 microseconds if it sleeps).
constexpr std::ptrdiff_t min_numbers_for_threads = 16384;

inline bool worth_threads(const std::array<int, 3>& extent) {
  return static_cast<std::ptrdiff_t>(extent[0]) * extent[1] * extent[2] >= min_numbers_for_threads;
}

// |value|, or infinity for what is not a number: then a maximum does not lose it.
inline double magnitude(double value) {
  return value == value ? std::abs(value) : std::numeric_limits<double>::infinity();
}

// body(k) for k = 0 .. extent[2] - 1, by several threads if the arrays are large. The choice does not depend on the
// number of threads: whatever that is, the same instructions give the same bits.
template <class Body>
void for_each_plane(const std::array<int, 3>& extent, Body&& body) {
  if (worth_threads(extent)) {
    keep_waits_short();
#pragma omp parallel for schedule(static)
    for (int k = 0; k < extent[2]; ++k) body(k);
  } else {
    for (int k = 0; k < extent[2]; ++k) body(k);
  }
}

// The largest value(k), likewise.
template <class Value>
double max_over_planes(const std::array<int, 3>& extent, Value&& value) {
  double largest = -std::numeric_limits<double>::infinity();
  if (worth_threads(extent)) {
    keep_waits_short();
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (int k = 0; k < extent[2]; ++k) largest = std::max(largest, value(k));
  } else {
    for (int k = 0; k < extent[2]; ++k) largest = std::max(largest, value(k));
  }
  return largest;
}

}  // namespace vesiflow::fluid
