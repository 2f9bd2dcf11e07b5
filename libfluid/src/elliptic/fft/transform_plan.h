// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Planned sine, cosine and Fourier transforms of a plane.
#pragma once

#include <array>
#include <cstddef>

#include "elliptic/fft/line_transform.h"

namespace vesiflow::fluid {

// Transforms nx x ny numbers along both axes. forward then backward multiplies by LineTransform::pair_factor()
// of each axis.
class TransformPlan {
 public:
  TransformPlan(std::array<int, 2> extent, std::array<Basis, 2> basis, Direction direction);

  // Rows of the input and of the output, which may be the same, are the given strides apart. scratch is
  // scratch_size() numbers from allocate_aligned. Any number of threads may do this at once, each with its own
  // scratch.
  void execute(const double* in, std::ptrdiff_t in_stride, double* out, std::ptrdiff_t out_stride,
               double* scratch) const;

  static std::size_t scratch_size(std::array<int, 2> extent, std::array<Basis, 2> basis);

 private:
  std::array<int, 2> extent_;
  LineTransform along_x_, along_y_;
};

}  // namespace vesiflow::fluid
