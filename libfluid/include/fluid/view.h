// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Non-owning three-dimensional arrays with contiguous rows: what solvers and loops over any centring work on.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace vesiflow::fluid {

/// extent[0] x extent[1] x extent[2] numbers, x fastest: element (i, j, k) is at data[i + j * row_stride + k *
/// plane_stride]. Views of fields may be indexed one layer outside (ghosts).
template <class T>
struct BasicView {
  T* data = nullptr;                ///< element (0, 0, 0)
  std::array<int, 3> extent{};      ///< number of elements along each axis
  std::ptrdiff_t row_stride = 0;    ///< distance of neighbours along y
  std::ptrdiff_t plane_stride = 0;  ///< distance of neighbours along z

  T* row(int j, int k) const { return data + j * row_stride + k * plane_stride; }  ///< pointer to element (0, j, k)
  T& operator()(int i, int j, int k) const { return row(j, k)[i]; }                ///< element (i, j, k)

  /// A view of numbers is a view of constant numbers.
  operator BasicView<const T>() const requires(!std::is_const_v<T>) { return {data, extent, row_stride, plane_stride}; }
};

using View = BasicView<double>;             ///< numbers to read and write
using ConstView = BasicView<const double>;  ///< numbers to read

/// The arrays that make up one vector of unknowns: a single view for a scalar, three for a velocity. Views and arrays
/// of three views convert to it.
template <class T>
class BasicBlocks {
  using Mutable = std::remove_const_t<T>;

 public:
  /// The array of a scalar.
  BasicBlocks(const BasicView<T>& view) : views_{view}, count_(1) {}
  /// The arrays of a velocity.
  BasicBlocks(const std::array<BasicView<T>, 3>& views) : views_(views), count_(3) {}
  /// The array of a scalar, to read.
  BasicBlocks(const BasicView<Mutable>& view) requires(std::is_const_v<T>) : views_{view}, count_(1) {}
  /// The arrays of a velocity, to read.
  BasicBlocks(const std::array<BasicView<Mutable>, 3>& views) requires(std::is_const_v<T>)
      : views_{views[0], views[1], views[2]}, count_(3) {}
  /// The same arrays, to read.
  template <class U>
  BasicBlocks(const BasicBlocks<U>& blocks) requires(std::is_const_v<T>&& std::is_same_v<U, Mutable>)
      : count_(blocks.count()) {
    for (int b = 0; b < count_; ++b) views_[b] = blocks[b];
  }

  int count() const { return count_; }  ///< number of arrays

  /// One of the arrays.
  const BasicView<T>& operator[](int block) const { return views_[block]; }
  const BasicView<T>* begin() const { return views_.data(); }         ///< the first array
  const BasicView<T>* end() const { return views_.data() + count_; }  ///< past the last array

 private:
  std::array<BasicView<T>, 3> views_{};
  int count_;
};

using Blocks = BasicBlocks<double>;             ///< a vector of unknowns to read and write
using ConstBlocks = BasicBlocks<const double>;  ///< a vector of unknowns to read

}  // namespace vesiflow::fluid
