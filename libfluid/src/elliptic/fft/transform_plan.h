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
template <class Scalar>
class TransformPlan {
 public:
  TransformPlan(std::array<int, 2> extent, std::array<Basis, 2> basis, Direction direction);

  // Rows of numbers, these strides apart.
  template <class Number>
  struct Rows {
    Number* first = nullptr;
    std::ptrdiff_t stride = 0;
    Number* row(int j) const { return first + j * stride; }
  };

  // The transform of the input, to which `base` is added unless that is null, into the output; these may be the same
  // arrays. Of double and Scalar; single precision has one of each. scratch is scratch_size() numbers from
  // allocate_aligned. Any number of threads may do this at once, each with its own scratch.
  template <class In, class Out>
  void execute(Rows<const In> in, Rows<Out> out, Rows<const Out> base, Scalar* scratch) const;

  static std::size_t scratch_size(std::array<int, 2> extent, std::array<Basis, 2> basis);

 private:
  std::array<int, 2> extent_;
  LineTransform<Scalar> along_x_, along_y_;
};

}  // namespace vesiflow::fluid
