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

}  // namespace vesiflow::fluid
