// Both axes go through blocks of `lanes` lines that fit the first-level cache: rows (transposed on the way) from
// the input to a plane in scratch, columns from there to the output.
#include "transform_plan.h"

#include <algorithm>
#include <array>

#include "aligned_array.h"
#include "lanes.h"

namespace vesiflow::fluid {
namespace {

std::size_t plane_size(std::array<int, 2> extent) {
  return static_cast<std::size_t>(padded(extent[0]) * padded(extent[1]));
}

// Room for the lines of both axes.
std::size_t block_size(std::array<int, 2> extent, std::array<Basis, 2> basis) {
  return std::max(LineTransform::block_size(basis[0], extent[0]), LineTransform::block_size(basis[1], extent[1]));
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

void store_rows(const double* result, int n, const Place* place, double* plane, std::ptrdiff_t stride) {
  for (int l = 0; l < lanes; l += 4) {
    int i = 0;
    for (; i + 4 <= n; i += 4) {
      std::array<Vector4, 4> v;
      for (int c = 0; c < 4; ++c) v[c] = place[i + c].sign * load4(result + place[i + c].offset + l);
      transpose(v);
      for (int r = 0; r < 4; ++r) store4(plane + (l + r) * stride + i, v[r]);
    }
    for (; i < n; ++i) {
      for (int r = l; r < l + 4; ++r) plane[r * stride + i] = place[i].sign * result[place[i].offset + r];
    }
  }
}

void load_columns(const double* plane, std::ptrdiff_t stride, int n, const Place* place, double* block) {
  for (int j = 0; j < n; ++j) {
    for (int l = 0; l < lanes; l += 4) {
      store4(block + place[j].offset + l, place[j].sign * load4(plane + j * stride + l));
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
    : extent_(extent),
      row_stride_(padded(extent[0])),
      block_size_(block_size(extent, basis)),
      along_x_(extent[0], basis[0], direction),
      along_y_(extent[1], basis[1], direction) {}

std::size_t TransformPlan::scratch_size(std::array<int, 2> extent, std::array<Basis, 2> basis) {
  return plane_size(extent) + 2 * block_size(extent, basis);
}

void TransformPlan::execute(const double* in, std::ptrdiff_t in_stride, double* out, std::ptrdiff_t out_stride,
                            double* scratch) const {
  const auto [nx, ny] = extent_;
  double* plane = scratch;
  double* block = plane + plane_size(extent_);
  double* result = block + block_size_;
  for (int j = 0; j < ny; j += lanes) {
    load_rows(in, in_stride, j, ny, nx, along_x_.input(), block);
    along_x_.execute(block, result);
    store_rows(result, nx, along_x_.output(), plane + j * row_stride_, row_stride_);
  }
  for (int i = 0; i < nx; i += lanes) {
    load_columns(plane + i, row_stride_, ny, along_y_.input(), block);
    along_y_.execute(block, result);
    store_columns(result, std::min(lanes, nx - i), ny, along_y_.output(), out + i, out_stride);
  }
}

}  // namespace vesiflow::fluid
