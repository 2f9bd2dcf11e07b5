// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Both axes go through blocks of `lanes` lines that fit the first-level cache: rows, transposed on the way in, from the
// input to as many blocks in scratch as there are, columns from there, transposed back, to the output. Lines of memory
// are asked for one block ahead.
#include "elliptic/fft/transform_plan.h"

#include <algorithm>
#include <array>

#include "elliptic/fft/lanes.h"
#include "grid/aligned_array.h"

namespace vesiflow::fluid {
namespace {

template <class Scalar>
std::size_t row_blocks(const std::array<int, 2>& extent) {
  return (extent[1] + lanes<Scalar> - 1) / lanes<Scalar>;
}

// A square of numbers as many as a Pack has, transposed.
template <class Scalar>
using Square = std::array<Pack<Scalar>, pack<Scalar>>;

// Numbers i, i + 1 .. of the rows, transposed, into the block.
template <class In, class Scalar>
void load_square(const std::array<const In*, pack<Scalar>>& row, int i, const Place<Scalar>* place, Scalar* block) {
  Square<Scalar> v;
  for (int r = 0; r < pack<Scalar>; ++r) v[r] = load_rounded<Scalar>(row[r] + i);
  transpose(v);
  for (int c = 0; c < pack<Scalar>; ++c) store_pack(block + place[i + c].offset, place[i + c].sign * v[c]);
}

// Rows j .. j + lanes - 1 of ny rows of n numbers; beyond the last row, that one again.
template <class In, class Scalar>
void load_rows(const In* in, std::ptrdiff_t stride, int j, int ny, int n, const Place<Scalar>* place, Scalar* block) {
  for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>) {
    std::array<const In*, pack<Scalar>> row;
    for (int r = 0; r < pack<Scalar>; ++r) row[r] = in + std::min(j + l + r, ny - 1) * stride;
    int i = 0;
    for (; i + pack<Scalar> <= n; i += pack<Scalar>) load_square(row, i, place, block + l);
    for (; i < n; ++i) {
      for (int r = 0; r < pack<Scalar>; ++r)
        block[place[i].offset + l + r] = place[i].sign * static_cast<Scalar>(row[r][i]);
    }
  }
}

// Numbers in a line of memory.
template <class Number>
constexpr int per_line = static_cast<int>(64 / sizeof(Number));

template <class In>
void prefetch_rows(const In* in, std::ptrdiff_t stride, int first, int end, int n) {
  for (int j = first; j < end; ++j) {
    for (int i = 0; i < n; i += per_line<In>) __builtin_prefetch(in + j * stride + i, 0, 2);
  }
}

template <class Out>
void prefetch_columns(const Out* out, std::ptrdiff_t stride, int n) {
  for (int j = 0; j < n; ++j) __builtin_prefetch(out + j * stride, 1, 2);
}

// Columns of numbers of columns first .. first + lanes - 1 from the transformed blocks of rows; beyond the last, that one again.
template <class Scalar>
void load_columns(const Scalar* rows, std::size_t block_size, std::array<int, 2> extent, int first,
                  const Place<Scalar>* mode, const Place<Scalar>* place, Scalar* block) {
  constexpr int width = pack<Scalar>;
  const auto [nx, ny] = extent;
  for (int l = 0; l < lanes<Scalar>; l += width) {
    std::array<const Scalar*, width> column;
    Pack<Scalar> sign;
    for (int c = 0; c < width; ++c) {
      const Place<Scalar>& from = mode[std::min(first + l + c, nx - 1)];
      column[c] = rows + from.offset;
      sign[c] = from.sign;
    }
    for (int j = 0; j < ny; j += width) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j / lanes<Scalar> * block_size) + j % lanes<Scalar>;
      Square<Scalar> v;
      for (int c = 0; c < width; ++c) v[c] = load_pack(column[c] + at);
      transpose(v);
      for (int r = 0; r < std::min(width, ny - j); ++r) {
        store_pack(block + place[j + r].offset + l, place[j + r].sign * sign * v[r]);
      }
    }
  }
}

// To base, if that is there, are added the columns.
template <class Out, class Scalar>
void store_columns(const Scalar* result, int columns, int n, const Place<Scalar>* place, const Out* base,
                   std::ptrdiff_t base_stride, Out* out, std::ptrdiff_t stride) {
  for (int j = 0; j < n; ++j) {
    const Scalar* from = result + place[j].offset;
    Out* to = out + j * stride;
    const Out* add = base != nullptr ? base + j * base_stride : nullptr;
    if (columns == lanes<Scalar>) {
      for (int l = 0; l < lanes<Scalar>; l += pack<Scalar>)
        store_widened(to + l, place[j].sign * load_pack(from + l), add != nullptr ? add + l : nullptr);
    } else {
      for (int l = 0; l < columns; ++l) {
        const Out value = place[j].sign * from[l];
        to[l] = add != nullptr ? add[l] + value : value;
      }
    }
  }
}

}  // namespace

template <class Scalar>
TransformPlan<Scalar>::TransformPlan(std::array<int, 2> extent, std::array<Basis, 2> basis, Direction direction)
    : extent_(extent), along_x_(extent[0], basis[0], direction), along_y_(extent[1], basis[1], direction) {}

template <class Scalar>
std::size_t TransformPlan<Scalar>::scratch_size(std::array<int, 2> extent, std::array<Basis, 2> basis) {
  const std::size_t along_x = LineTransform<Scalar>::block_size(basis[0], extent[0]);
  const std::size_t along_y = LineTransform<Scalar>::block_size(basis[1], extent[1]);
  return row_blocks<Scalar>(extent) * along_x + std::max(along_x, along_y) + along_y;
}

template <class Scalar>
template <class In, class Out>
void TransformPlan<Scalar>::execute(Rows<const In> in, Rows<Out> out, Rows<const Out> base, Scalar* scratch) const {
  const auto [nx, ny] = extent_;
  constexpr int step = lanes<Scalar>;
  const std::size_t rows_size = along_x_.block_size();
  Scalar* rows = scratch;
  Scalar* block = rows + row_blocks<Scalar>(extent_) * rows_size;
  Scalar* result = block + std::max(rows_size, along_y_.block_size());
  for (int j = 0; j < ny; j += step) {
    load_rows(in.first, in.stride, j, ny, nx, along_x_.input(), block);
    prefetch_rows(in.first, in.stride, j + step, std::min(j + 2 * step, ny), nx);
    along_x_.execute(block, rows + j / step * rows_size);
  }
  for (int i = 0; i < nx; i += step) {
    load_columns(rows, rows_size, extent_, i, along_x_.output(), along_y_.input(), block);
    for (int ahead = step + per_line<Out>; ahead <= 2 * step; ahead += per_line<Out>) {
      prefetch_columns(out.first + std::min(i + ahead, nx) - 1, out.stride, ny);
      if (base.first != nullptr) prefetch_columns(base.first + std::min(i + ahead, nx) - 1, base.stride, ny);
    }
    along_y_.execute(block, result);
    store_columns(result, std::min(step, nx - i), ny, along_y_.output(),
                  base.first != nullptr ? base.first + i : nullptr, base.stride, out.first + i, out.stride);
  }
}

template class TransformPlan<double>;
template void TransformPlan<double>::execute(Rows<const double>, Rows<double>, Rows<const double>, double*) const;
template class TransformPlan<float>;
template void TransformPlan<float>::execute(Rows<const double>, Rows<float>, Rows<const float>, float*) const;
template void TransformPlan<float>::execute(Rows<const float>, Rows<double>, Rows<const double>, float*) const;

}  // namespace vesiflow::fluid
