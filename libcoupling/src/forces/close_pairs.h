// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "forces/periodic_images.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Finds pairs of markers, one of each of two membranes, that are nearer than a range: only markers within the range of the
/// other membrane's bounds are looked at, and these through a list of cells not smaller than the range. Allocates in its constructor
/// only.
class ClosePairs {
 public:
  ClosePairs(double range, Eigen::Index largest_markers);

  /// visit(m, n, r, distance) with r = a_m - (b_n + shift), distance = |r| in (0, range). The order depends on the markers only.
  template <class Visit>
  void visit(const vesicle::VectorField& a, const Bounds& bounds_a, const vesicle::VectorField& b,
             const Bounds& bounds_b, const vesicle::Vector3& shift, Visit&& visit) {
    sort_into_cells(bounds_a, b, bounds_b, shift);
    if (cell_start_[cells_[0] * cells_[1] * cells_[2]] == 0) return;
    for (Eigen::Index m = 0; m < a.rows(); ++m) {
      const vesicle::Vector3 x = a.row(m).matrix().transpose();
      const vesicle::Vector3 s = (x - origin_).cwiseProduct(per_cell_);
      std::array<int, 3> first{}, last{};
      for (int axis = 0; axis < 3; ++axis) {
        first[axis] = clamped(s(axis) - 1.0, 0, cells_[axis]);
        last[axis] = clamped(s(axis) + 1.0, -1, cells_[axis] - 1);
      }
      for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
          for (int i = first[0]; i <= last[0]; ++i) {
            const int cell = (k * cells_[1] + j) * cells_[0] + i;
            for (int entry = cell_start_[cell]; entry < cell_start_[cell + 1]; ++entry) {
              const Eigen::Index n = sorted_[entry];
              const vesicle::Vector3 r = x - b.row(n).matrix().transpose() - shift;
              const double distance = r.norm();
              if (distance > 0.0 && distance < range_) visit(m, n, r, distance);
            }
          }
    }
  }

 private:
  void sort_into_cells(const Bounds& bounds_a, const vesicle::VectorField& b, const Bounds& bounds_b,
                       const vesicle::Vector3& shift);
  int cell_of(const vesicle::Vector3& x) const;
  static int clamped(double cell, int low, int high) {
    return cell < low ? low : cell > high ? high : static_cast<int>(std::floor(cell));
  }

  double range_;
  int cells_per_axis_;  // at most
  std::array<int, 3> cells_{};
  vesicle::Vector3 origin_, per_cell_;
  std::vector<std::int32_t> candidates_, cell_of_candidate_, cell_start_, sorted_;
};

}  // namespace vesiflow::coupling
