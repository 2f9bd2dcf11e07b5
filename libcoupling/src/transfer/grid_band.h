// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "fluid/centring.h"
#include "fluid/grid.h"
#include "transfer/feet.h"
#include "transfer/fine_surface.h"
#include "transfer/grid_box.h"
#include "transfer/nearest_nodes.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// The points of one centring of the grid that are near a surface: their signed distances (positive outside), and the
/// jump continued to each by Taylor's expansion along the normal through its foot, the closest point of the surface.
///
/// Held as a list of these points, plane by plane, and as a dense box around the surface, for stencils. Indices run on
/// across periodic axes: i and i + cells are the same point of the grid, seen from a surface that lies across the end of
/// the box.
///
/// Below 0 they run on beyond mirror planes, too (Grid::mirror), where each point is the mirror image of one of the grid:
/// of -1 - i or, of faces normal to the axis, of -i. A surface on one side of a plane has points beyond it as far as it
/// reaches. Of one across it, which is symmetric about it, the box has those layers that differences at points of the
/// grid and readers on its side need.
class GridBand {
 public:
  struct Point {
    std::array<int, 3> index;
    std::int32_t at;  ///< its offset()
    /// May be at the distance `far`, if it turned out not to belong to the band.
    Foot foot;
    double distance() const { return foot.distance; }
  };

  /// \param across per axis with a mirror plane: whether the surface lies across it. Without meaning for the other axes.
  GridBand(const fluid::Grid& grid, fluid::Centring centring, const std::array<bool, 3>& across = {true, true, true});

  /// Finds the points within `width` of the surface and their feet. They do not depend on what was found before.
  /// \param readers positions on the surface, shape (readers, 3), on the grid's side of mirror planes that it lies
  /// across: what they read is in the band however far it is. None if null
  void update(const FineSurface& surface, double width, const vesicle::VectorField* readers = nullptr);

  /// Evaluates the jump at these points from `record` of the same surface: four numbers g, g_n, g_nn, g_nnn give
  /// g + d g_n + d^2/2 g_nn + d^3/6 g_nnn.
  void evaluate(const FineSurface& surface, int record);

  /// The points of the band, in an order that does not depend on the number of threads.
  std::span<const Point> points() const { return points_; }
  /// Points of the band.
  std::size_t count() const;

  /// Where the box begins, and its extent.
  const std::array<int, 3>& first() const { return box_.first; }
  const std::array<int, 3>& extent() const { return box_.extent; }
  bool contains(int i, int j, int k) const { return box_.contains(i, j, k); }
  std::ptrdiff_t offset(int i, int j, int k) const { return box_.offset(i, j, k); }
  std::ptrdiff_t stride(int axis) const { return box_.stride(axis); }

  Eigen::Vector3d position(const std::array<int, 3>& index) const {
    return {box_.coordinate(0, index[0]), box_.coordinate(1, index[1]), box_.coordinate(2, index[2])};
  }
  /// Where a point with that index, or the one that it is the mirror image of, is in the arrays of the grid.
  int in_grid(int axis, int index) const {
    return in_grid_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(index - box_.first[axis])];
  }
  /// What a field of this centring is there over what it is at in_grid(): of the component normal to a mirror plane -1
  /// beyond the plane, and 0 on it.
  double sign(int axis, int index) const { return !is_odd_[axis] || index > 0 ? 1.0 : index == 0 ? 0.0 : -1.0; }
  /// Whether a point is neither beyond nor on a mirror plane that the surface lies across: what is put at the others is
  /// the mirror image of what is put at these.
  bool is_on_side(const std::array<int, 3>& index) const {
    for (int axis = 0; axis < 3; ++axis)
      if (is_across_[axis] && index[axis] < (is_odd_[axis] ? 1 : 0)) return false;
    return true;
  }

  /// Signed distance, or `far` beyond the band.
  static constexpr double far = 1e300;
  double distance(std::ptrdiff_t at) const { return distance_[static_cast<std::size_t>(at)]; }
  bool is_inside(std::ptrdiff_t at) const { return distance(at) < 0.0; }
  /// Zero beyond the band.
  double jump(std::ptrdiff_t at) const { return jump_[static_cast<std::size_t>(at)]; }
  /// What takes the value at a point, which is that of its side, to the mean of both sides: half the jump inside, less
  /// half of it outside.
  double to_mean(std::ptrdiff_t at) const { return to_mean_[static_cast<std::size_t>(at)]; }
  /// Another surface has a jump too, which is evaluated: readers of this one find at points inside of the other, and of
  /// its images by periods and in mirror planes, what is outside of it, continued. Of itself: at points inside of its
  /// images. Until the next evaluate().
  void read_past(const GridBand& other);
  /// What readers add to the values at points, as a pointer into the box: to_mean(), and what others add.
  const double* to_read(int i, int j, int k) const {
    return (reads_past_others_ ? to_read_ : to_mean_).data() + offset(i, j, k);
  }

  /// Points along each axis that a reader reads.
  static constexpr int read_points = 4;
  /// Where a reader reads along an axis: the points from the first on, the second of them `fraction` below it.
  struct Reading {
    int first;
    double fraction;
  };
  Reading reading(int axis, double position) const {
    const double at = box_.index_at(axis, position), below = std::floor(at);
    return {static_cast<int>(below) - 1, at - below};
  }

 private:
  /// Layers of points beyond a mirror plane, of a surface across it: readers take two, differences one.
  static constexpr int layers_beyond = read_points / 2;

  /// Along one axis, of the indices of a surface those of an image.
  struct Image {
    int shift;
    bool is_mirrored;
    int of(int index) const { return is_mirrored ? shift - index : shift + index; }
  };
  struct Images {
    Image first;
    int count;
    bool have_mirrored;  // the last of them; else each is a period further than the one before
  };
  // The field is the component normal to the mirror plane, which the surface lies across: it vanishes there.
  bool is_on_odd_plane(const std::array<int, 3>& index) const {
    for (int axis = 0; axis < 3; ++axis)
      if (is_odd_[axis] && is_across_[axis] && index[axis] == 0) return true;
    return false;
  }
  Images images(int axis, const GridBand& other) const;
  Image image(int axis, const Images& all, int number) const;

  void frame(const FineSurface& surface, double width, const vesicle::VectorField* readers);
  void list_candidates(double reach, const vesicle::VectorField* readers);
  void mark_read(const vesicle::VectorField& readers, int first_plane, int end_plane);
  void project(const FineSurface& surface, double width);

  std::array<int, 3> period_;               // in points, or 0
  std::array<bool, 3> is_mirrored_;         // the axis
  std::array<bool, 3> is_across_, is_odd_;  // mirror planes: the surface, and the field
  GridBox box_;
  std::array<std::vector<int>, 3> in_grid_;
  NearestNodes nearest_;
  std::vector<double> distance_, jump_, to_mean_;
  std::vector<double> to_read_;  // only where others are near
  bool reads_past_others_ = false;
  std::vector<NearestNodes::Key> limits_;  // of the keys of candidates
  std::vector<int> first_of_plane_;        // among the points
  std::vector<Point> points_;
};

}  // namespace vesiflow::coupling
