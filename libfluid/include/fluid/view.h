// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Non-owning three-dimensional arrays with contiguous rows: what solvers and loops over any centring work on.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace vesiflow::fluid {

// extent[0] x extent[1] x extent[2] numbers, x fastest: element (i, j, k) is at
// data[i + j * row_stride + k * plane_stride]. Views of fields may be indexed one layer outside (ghosts).
template <class T>
struct BasicView {
  T* data = nullptr;
  std::array<int, 3> extent{};
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t plane_stride = 0;

  T* row(int j, int k) const { return data + j * row_stride + k * plane_stride; }
  T& operator()(int i, int j, int k) const { return row(j, k)[i]; }

  // A view of numbers is a view of constant numbers.
  operator BasicView<const T>() const requires(!std::is_const_v<T>) { return {data, extent, row_stride, plane_stride}; }
};

using View = BasicView<double>;
using ConstView = BasicView<const double>;

// The arrays that make up one vector of unknowns: a single view for a scalar, three for a velocity. Views and arrays
// of three views convert to it.
template <class T>
class BasicBlocks {
  using Mutable = std::remove_const_t<T>;

 public:
  BasicBlocks(const BasicView<T>& view) : views_{view}, count_(1) {}
  BasicBlocks(const std::array<BasicView<T>, 3>& views) : views_(views), count_(3) {}
  BasicBlocks(const BasicView<Mutable>& view) requires(std::is_const_v<T>) : views_{view}, count_(1) {}
  BasicBlocks(const std::array<BasicView<Mutable>, 3>& views) requires(std::is_const_v<T>)
      : views_{views[0], views[1], views[2]}, count_(3) {}
  template <class U>
  BasicBlocks(const BasicBlocks<U>& blocks) requires(std::is_const_v<T>&& std::is_same_v<U, Mutable>)
      : count_(blocks.count()) {
    for (int b = 0; b < count_; ++b) views_[b] = blocks[b];
  }

  int count() const { return count_; }
  const BasicView<T>& operator[](int block) const { return views_[block]; }
  const BasicView<T>* begin() const { return views_.data(); }
  const BasicView<T>* end() const { return views_.data() + count_; }

 private:
  std::array<BasicView<T>, 3> views_{};
  int count_;
};

using Blocks = BasicBlocks<double>;
using ConstBlocks = BasicBlocks<const double>;

}  // namespace vesiflow::fluid
