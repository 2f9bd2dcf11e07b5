// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "fluid/centring.h"
#include "fluid/grid.h"
#include "transfer/fine_surface.h"

namespace vesiflow::coupling {

/// The points of one centring of the grid that are near a surface: their signed distances (positive outside), and the
/// jump continued to each by Taylor's expansion along the normal through its closest point of the surface.
///
/// Held as a dense box of points around the surface. Indices run on across periodic axes: i and i + cells are the same
/// point of the grid, seen from a surface that lies across the end of the box.
class GridBand {
 public:
  GridBand(const fluid::Grid& grid, fluid::Centring centring);

  /// Finds the points within `width` of the surface and their closest points on it.
  void update(const FineSurface& surface, double width);

  /// Evaluates the jump at these points from `record` of the same surface: four numbers g, g_n, g_nn, g_nnn give
  /// g + d g_n + d^2/2 g_nn + d^3/6 g_nnn.
  void evaluate(const FineSurface& surface, int record);

  /// Where the box begins, and its extent.
  const std::array<int, 3>& first() const { return first_; }
  const std::array<int, 3>& extent() const { return extent_; }

  bool contains(int i, int j, int k) const {
    return i >= first_[0] && i < first_[0] + extent_[0] && j >= first_[1] && j < first_[1] + extent_[1] &&
           k >= first_[2] && k < first_[2] + extent_[2];
  }
  std::ptrdiff_t offset(int i, int j, int k) const {
    return (std::ptrdiff_t{k - first_[2]} * extent_[1] + (j - first_[1])) * extent_[0] + (i - first_[0]);
  }
  std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? extent_[0] : std::ptrdiff_t{extent_[0]} * extent_[1];
  }
  /// Signed distance, or `far` beyond the band.
  static constexpr double far = 1e300;
  double distance(std::ptrdiff_t at) const { return distance_[static_cast<std::size_t>(at)]; }
  double jump(std::ptrdiff_t at) const { return jump_[static_cast<std::size_t>(at)]; }
  bool is_inside(std::ptrdiff_t at) const { return distance(at) < 0.0; }

  /// Points of the band.
  std::size_t count() const { return feet_.size(); }

 private:
  void frame(const FineSurface& surface, double width);
  void find_nearest_nodes(const FineSurface& surface, double width);
  void project(const FineSurface& surface, double width);

  fluid::Grid grid_;
  fluid::Centring centring_;
  fluid::Vector3 origin_;  // of the point (0, 0, 0)
  fluid::Vector3 spacing_;
  std::array<int, 3> first_{}, extent_{};
  std::vector<double> distance_, jump_;
  std::vector<float> nearest_;  // squared distance of the nearest node
  std::vector<int> node_;       // and its number, or -1
  struct FootOfPoint {
    std::size_t point;
    double distance;
    FineSurface::Place place;
  };
  std::vector<FootOfPoint> feet_;
};

}  // namespace vesiflow::coupling
