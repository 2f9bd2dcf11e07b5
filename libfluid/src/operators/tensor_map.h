// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Linear maps between arrays that are tensor products of sparse one-dimensional maps: transfers between grids.
#pragma once

#include <array>
#include <vector>

#include "fluid/centring.h"
#include "fluid/grid.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

// A sparse matrix from the points along an axis of one grid to those of another, row after row.
class LineMap {
 public:
  struct Entry {
    int index;
    double weight;
  };

  // From the unknowns of a coarse grid of the same box: linear interpolation of a velocity, zero on walls
  // and symmetric about mirrors.
  static LineMap interpolation(const Grid& coarse, const Grid& fine, Centring centring, int axis);
  // The transpose, scaled to keep the mean.
  static LineMap restriction(const Grid& fine, const Grid& coarse, Centring centring, int axis);
  // Means over the cells of the coarse grid of a function that is constant in each fine cell.
  static LineMap cell_average(const Grid& fine, const Grid& coarse, int axis);

  int rows() const { return static_cast<int>(starts_.size()) - 1; }
  int columns() const { return columns_; }
  const Entry* begin(int row) const { return entries_.data() + starts_[row]; }
  const Entry* end(int row) const { return entries_.data() + starts_[row + 1]; }

 private:
  LineMap(int columns, const std::vector<std::vector<Entry>>& rows);

  int columns_;
  std::vector<int> starts_{0};
  std::vector<Entry> entries_;
};

class TensorMap {
 public:
  explicit TensorMap(std::array<LineMap, 3> lines);
  // to = M from, or to += M from. Parallel over planes.
  void apply(ConstView from, View to) { apply<false>(from, to); }
  void add(ConstView from, View to) { apply<true>(from, to); }

 private:
  template <bool accumulate>
  void apply(ConstView from, View to);

  std::array<LineMap, 3> lines_;
  std::vector<double> rows_;  // one for each plane of the result
};

}  // namespace vesiflow::fluid
