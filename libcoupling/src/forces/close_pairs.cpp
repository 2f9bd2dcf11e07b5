// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "forces/close_pairs.h"

#include <algorithm>

namespace vesiflow::coupling {

ClosePairs::ClosePairs(double range, Eigen::Index largest_markers)
    : range_(range), cells_per_axis_(std::max(1, static_cast<int>(std::cbrt(static_cast<double>(largest_markers))))) {
  const auto markers = static_cast<std::size_t>(largest_markers);
  candidates_.reserve(markers);
  cell_of_candidate_.reserve(markers);
  sorted_.reserve(markers);
  const auto per_axis = static_cast<std::size_t>(cells_per_axis_);
  cell_start_.reserve(per_axis * per_axis * per_axis + 1);
}

int ClosePairs::cell_of(const vesicle::Vector3& x) const {
  const vesicle::Vector3 s = (x - origin_).cwiseProduct(per_cell_);
  int cell = 0;
  for (int axis = 2; axis >= 0; --axis) cell = cell * cells_[axis] + clamped(s(axis), 0, cells_[axis] - 1);
  return cell;
}

// The markers of b + shift that lie within the range of the bounds of a, in the order of their cells.
void ClosePairs::sort_into_cells(const Bounds& bounds_a, const vesicle::VectorField& b, const Bounds& bounds_b,
                                 const vesicle::Vector3& shift) {
  const vesicle::Vector3 lower = (bounds_b.lower + shift).cwiseMax((bounds_a.lower.array() - range_).matrix());
  const vesicle::Vector3 upper = (bounds_b.upper + shift).cwiseMin((bounds_a.upper.array() + range_).matrix());
  origin_ = lower;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::max(0.0, upper(axis) - lower(axis));
    cells_[axis] = std::clamp(static_cast<int>(std::min(extent / range_, 1e6)), 1, cells_per_axis_);
    per_cell_(axis) = extent > 0.0 ? cells_[axis] / std::max(extent, range_) : 1.0 / range_;
  }
  candidates_.clear();
  cell_of_candidate_.clear();
  cell_start_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2] + 1), 0);
  for (Eigen::Index n = 0; n < b.rows(); ++n) {
    const vesicle::Vector3 x = b.row(n).matrix().transpose() + shift;
    if ((x.array() < lower.array()).any() || (x.array() > upper.array()).any()) continue;
    candidates_.push_back(static_cast<std::int32_t>(n));
    cell_of_candidate_.push_back(cell_of(x));
    ++cell_start_[static_cast<std::size_t>(cell_of_candidate_.back())];
  }
  // Counts become starts: after the running sum each is the end of its cell, and filling from the back moves it to its start.
  std::int32_t sum = 0;
  for (std::int32_t& entry : cell_start_) entry = sum += entry;
  sorted_.resize(candidates_.size());
  for (std::size_t c = candidates_.size(); c-- > 0;)
    sorted_[static_cast<std::size_t>(--cell_start_[static_cast<std::size_t>(cell_of_candidate_[c])])] = candidates_[c];
}

}  // namespace vesiflow::coupling
