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

std::size_t row_blocks(const std::array<int, 2>& extent) {
  return (extent[1] + lanes - 1) / lanes;
}

// Numbers i .. i + 3 of four rows, transposed, into the block.
void load_group(const std::array<const double*, 4>& row, int i, const Place* place, double* block) {
  std::array<Vector4, 4> v{load4(row[0] + i), load4(row[1] + i), load4(row[2] + i), load4(row[3] + i)};
  transpose(v);
  for (int c = 0; c < 4; ++c) store4(block + place[i + c].offset, place[i + c].sign * v[c]);
}

// Rows j .. j + lanes - 1 of ny rows of n numbers; beyond the last row, that one again.
void load_rows(const double* in, std::ptrdiff_t stride, int j, int ny, int n, const Place* place, double* block) {
  for (int l = 0; l < lanes; l += 4) {
    std::array<const double*, 4> row;
    for (int r = 0; r < 4; ++r) row[r] = in + std::min(j + l + r, ny - 1) * stride;
    int i = 0;
    for (; i + 4 <= n; i += 4) load_group(row, i, place, block + l);
    for (; i < n; ++i) {
      const Vector4 v{row[0][i], row[1][i], row[2][i], row[3][i]};
      store4(block + place[i].offset + l, place[i].sign * v);
    }
  }
}

void prefetch_rows(const double* in, std::ptrdiff_t stride, int first, int end, int n) {
  for (int j = first; j < end; ++j) {
    for (int i = 0; i < n; i += 8) __builtin_prefetch(in + j * stride + i, 0, 2);
  }
}

void prefetch_columns(const double* out, std::ptrdiff_t stride, int n) {
  for (int j = 0; j < n; ++j) __builtin_prefetch(out + j * stride, 1, 2);
}

// Columns of numbers of columns first .. first + lanes - 1 from the transformed blocks of rows; beyond the last, that one again.
void load_columns(const double* rows, std::size_t block_size, std::array<int, 2> extent, int first, const Place* mode,
                  const Place* place, double* block) {
  const auto [nx, ny] = extent;
  for (int l = 0; l < lanes; l += 4) {
    std::array<const double*, 4> column;
    Vector4 sign;
    for (int c = 0; c < 4; ++c) {
      const Place& from = mode[std::min(first + l + c, nx - 1)];
      column[c] = rows + from.offset;
      sign[c] = from.sign;
    }
    for (int j = 0; j < ny; j += 4) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j / lanes * block_size) + j % lanes;
      std::array<Vector4, 4> v{load4(column[0] + at), load4(column[1] + at), load4(column[2] + at),
                               load4(column[3] + at)};
      transpose(v);
      for (int r = 0; r < std::min(4, ny - j); ++r) {
        store4(block + place[j + r].offset + l, place[j + r].sign * sign * v[r]);
      }
    }
  }
}

void store_columns(const double* result, int columns, int n, const Place* place, double* out, std::ptrdiff_t stride) {
  for (int j = 0; j < n; ++j) {
    const double* from = result + place[j].offset;
    double* to = out + j * stride;
    if (columns == lanes) {
      for (int l = 0; l < lanes; l += 4) store4(to + l, place[j].sign * load4(from + l));
    } else {
      for (int l = 0; l < columns; ++l) to[l] = place[j].sign * from[l];
    }
  }
}

}  // namespace

TransformPlan::TransformPlan(std::array<int, 2> extent, std::array<Basis, 2> basis, Direction direction)
    : extent_(extent), along_x_(extent[0], basis[0], direction), along_y_(extent[1], basis[1], direction) {}

std::size_t TransformPlan::scratch_size(std::array<int, 2> extent, std::array<Basis, 2> basis) {
  const std::size_t along_x = LineTransform::block_size(basis[0], extent[0]);
  const std::size_t along_y = LineTransform::block_size(basis[1], extent[1]);
  return row_blocks(extent) * along_x + std::max(along_x, along_y) + along_y;
}

void TransformPlan::execute(const double* in, std::ptrdiff_t in_stride, double* out, std::ptrdiff_t out_stride,
                            double* scratch) const {
  const auto [nx, ny] = extent_;
  const std::size_t rows_size = along_x_.block_size();
  double* rows = scratch;
  double* block = rows + row_blocks(extent_) * rows_size;
  double* result = block + std::max(rows_size, along_y_.block_size());
  for (int j = 0; j < ny; j += lanes) {
    load_rows(in, in_stride, j, ny, nx, along_x_.input(), block);
    prefetch_rows(in, in_stride, j + lanes, std::min(j + 2 * lanes, ny), nx);
    along_x_.execute(block, rows + j / lanes * rows_size);
  }
  for (int i = 0; i < nx; i += lanes) {
    load_columns(rows, rows_size, extent_, i, along_x_.output(), along_y_.input(), block);
    prefetch_columns(out + std::min(i + 2 * lanes, nx) - 1, out_stride, ny);
    along_y_.execute(block, result);
    store_columns(result, std::min(lanes, nx - i), ny, along_y_.output(), out + i, out_stride);
  }
}

}  // namespace vesiflow::fluid
