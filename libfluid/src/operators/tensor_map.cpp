// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "operators/tensor_map.h"
#include "grid/planes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vesiflow::fluid {
namespace {

using Rows = std::vector<std::vector<LineMap::Entry>>;

void add_entry(std::vector<LineMap::Entry>& row, int index, double weight) {
  if (weight == 0.0) return;
  for (LineMap::Entry& entry : row) {
    if (entry.index == index) {
      entry.weight += weight;
      return;
    }
  }
  row.push_back({index, weight});
}

Rows interpolation_rows(const Grid& coarse, const Grid& fine, Centring centring, int axis) {
  const int cells = coarse.cells[axis];
  const bool normal = is_face_normal(centring, axis);
  const bool periodic = coarse.periodic[axis];
  const double ratio = static_cast<double>(cells) / fine.cells[axis];
  // Adds a multiple of the value at a coarse point, which may be on a wall, on a mirror or a ghost.
  const auto add_point = [&](std::vector<LineMap::Entry>& row, int point, double weight) {
    if (periodic) {
      add_entry(row, (point + cells) % cells, weight);
    } else if (normal) {
      if (point > 0 && point < cells) add_entry(row, point - 1, weight);
    } else if (point < 0 || point == cells) {
      const bool even = point < 0 && coarse.mirror[axis];
      add_entry(row, std::clamp(point, 0, cells - 1), even ? weight : -weight);
    } else {
      add_entry(row, point, weight);
    }
  };
  Rows rows(static_cast<std::size_t>(unknown_extent(fine, centring)[axis]));
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    const double offset = normal ? first_unknown(fine, centring, axis) : 0.5;
    const double position = (i + offset) * ratio - (normal ? 0.0 : 0.5);
    const int below = static_cast<int>(std::floor(position));
    add_point(rows[i], below, below + 1 - position);
    add_point(rows[i], below + 1, position - below);
  }
  return rows;
}

}  // namespace

LineMap::LineMap(int columns, const std::vector<std::vector<Entry>>& rows) : columns_(columns) {
  for (const auto& row : rows) {
    entries_.insert(entries_.end(), row.begin(), row.end());
    starts_.push_back(static_cast<int>(entries_.size()));
  }
}

LineMap LineMap::interpolation(const Grid& coarse, const Grid& fine, Centring centring, int axis) {
  return {unknown_extent(coarse, centring)[axis], interpolation_rows(coarse, fine, centring, axis)};
}

LineMap LineMap::restriction(const Grid& fine, const Grid& coarse, Centring centring, int axis) {
  const Rows transposed = interpolation_rows(coarse, fine, centring, axis);
  const double scale = static_cast<double>(coarse.cells[axis]) / fine.cells[axis];
  Rows rows(static_cast<std::size_t>(unknown_extent(coarse, centring)[axis]));
  for (int i = 0; i < static_cast<int>(transposed.size()); ++i) {
    for (const Entry& entry : transposed[i]) rows[entry.index].push_back({i, scale * entry.weight});
  }
  return {static_cast<int>(transposed.size()), rows};
}

LineMap LineMap::cell_average(const Grid& fine, const Grid& coarse, int axis) {
  const int cells = fine.cells[axis];
  const double width = static_cast<double>(cells) / coarse.cells[axis];
  Rows rows(static_cast<std::size_t>(coarse.cells[axis]));
  for (int i = 0; i < coarse.cells[axis]; ++i) {
    for (int from = static_cast<int>(i * width); from < cells && from < (i + 1) * width; ++from) {
      const double overlap = std::min((i + 1) * width, from + 1.0) - std::max(i * width, static_cast<double>(from));
      if (overlap > 0.0) rows[i].push_back({from, overlap / width});
    }
  }
  return {cells, rows};
}

TensorMap::TensorMap(std::array<LineMap, 3> lines)
    : lines_(std::move(lines)), rows_(static_cast<std::size_t>(lines_[0].columns()) * lines_[2].rows()) {}

template <bool accumulate>
void TensorMap::apply(ConstView from, View to) {
  const int nx = from.extent[0];
  for_each_plane(to.extent, [&](int k) {
    double* row = rows_.data() + static_cast<std::size_t>(k) * nx;
    for (int j = 0; j < to.extent[1]; ++j) {
      std::fill_n(row, nx, 0.0);
      for (const LineMap::Entry* z = lines_[2].begin(k); z != lines_[2].end(k); ++z) {
        for (const LineMap::Entry* y = lines_[1].begin(j); y != lines_[1].end(j); ++y) {
          const double* source = from.row(y->index, z->index);
          const double weight = y->weight * z->weight;
#pragma omp simd
          for (int i = 0; i < nx; ++i) row[i] += weight * source[i];
        }
      }
      double* out = to.row(j, k);
      for (int i = 0; i < to.extent[0]; ++i) {
        double sum = accumulate ? out[i] : 0.0;
        for (const LineMap::Entry* x = lines_[0].begin(i); x != lines_[0].end(i); ++x) sum += x->weight * row[x->index];
        out[i] = sum;
      }
    }
  });
}

template void TensorMap::apply<false>(ConstView, View);
template void TensorMap::apply<true>(ConstView, View);

}  // namespace vesiflow::fluid
