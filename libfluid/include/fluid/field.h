// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Scalar fields on the staggered grid, with their centring in the type, and the velocity-like triple of face
/// fields.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <utility>

#include "fluid/centring.h"
#include "fluid/grid.h"
#include "fluid/view.h"

namespace vesiflow::fluid {

/// One number at every point of a centring, and one layer of ghosts on every side (edges and corners included).
///
/// - Points: i = 0 .. extent(0) - 1, and so on; for FaceX extent(0) = cells[0] + 1: i = 0 and i = cells[0] are on walls
///   (i = 0 on the mirror, if there is one), or on a periodic axis the same face.
/// - Ghosts: i = -1 and i = extent(0), and so on.
///
/// x is fastest: (i, j, k) is at row(j, k)[i]. The storage is zero at first and aligned to 64 bytes. Fields can be
/// moved; a copy is made by clone() and never by accident. A moved-from field can only be assigned to or destroyed.
template <class CentringTag>
class Field {
 public:
  static constexpr Centring centring = CentringTag::centring;  ///< where the points are

  /// A field of zeros on that grid.
  explicit Field(const Grid& grid)
      : grid_(grid),
        extent_(point_extent(grid, centring)),
        row_stride_(extent_[0] + 2),
        plane_stride_(row_stride_ * (extent_[1] + 2)),
        values_(static_cast<double*>(::operator new(sizeof(double) * size(), alignment))) {
    fill(0.0);
  }
  Field(Field&&) noexcept = default;             ///< takes over the storage of another field
  Field& operator=(Field&&) noexcept = default;  ///< takes over the storage of another field

  /// A copy, ghosts included.
  Field clone() const {
    Field copy(grid_);
    std::copy_n(data(), size(), copy.data());
    return copy;
  }
  /// Sets all points and ghosts.
  void fill(double value) { std::fill_n(data(), size(), value); }

  const Grid& grid() const { return grid_; }                    ///< the grid of the field
  int extent(int axis) const { return extent_[axis]; }          ///< number of points along an axis
  const std::array<int, 3>& extent() const { return extent_; }  ///< number of points along each axis

  /// Position of a point or, with indices outside the extent, of a ghost.
  Vector3 position(int i, int j, int k) const { return point_position(grid_, centring, i, j, k); }

  /// Value at a point or ghost.
  double& operator()(int i, int j, int k) { return row(j, k)[i]; }
  /// Value at a point or ghost.
  double operator()(int i, int j, int k) const { return row(j, k)[i]; }

  /// Pointer to point (0, j, k), for -1 <= j <= extent(1) and -1 <= k <= extent(2).
  double* row(int j, int k) { return values_.get() + offset(j, k); }
  /// The same, to read.
  const double* row(int j, int k) const { return values_.get() + offset(j, k); }

  /// The whole storage, ghosts included: size() numbers, the first of them ghost (-1, -1, -1).
  double* data() { return values_.get(); }
  /// The same, to read.
  const double* data() const { return values_.get(); }
  /// Numbers in the whole storage.
  std::size_t size() const { return static_cast<std::size_t>(plane_stride_ * (extent_[2] + 2)); }
  /// Distance in the storage between neighbours along x (which is 1), y and z.
  std::ptrdiff_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? row_stride_ : plane_stride_; }

  /// All points; the ghosts can be reached by indices -1 and extent.
  View points() { return {row(0, 0), extent_, row_stride_, plane_stride_}; }
  /// The same, to read.
  ConstView points() const { return {row(0, 0), extent_, row_stride_, plane_stride_}; }

  /// The points that are not on walls or mirrors, each once: all of a cell field; the inner faces of a face field, or
  /// on a periodic axis all but the last.
  View unknowns() { return {at_first_unknown(row(0, 0)), unknown_extent(grid_, centring), row_stride_, plane_stride_}; }
  /// The same, to read.
  ConstView unknowns() const {
    return {at_first_unknown(row(0, 0)), unknown_extent(grid_, centring), row_stride_, plane_stride_};
  }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Release {
    void operator()(double* values) const { ::operator delete(values, alignment); }
  };

  std::ptrdiff_t offset(int j, int k) const {
    assert(-1 <= j && j <= extent_[1] && -1 <= k && k <= extent_[2]);
    return (k + 1) * plane_stride_ + (j + 1) * row_stride_ + 1;
  }
  template <class T>
  T* at_first_unknown(T* first_point) const {
    for (int axis = 0; axis < 3; ++axis) first_point += first_unknown(grid_, centring, axis) * stride(axis);
    return first_point;
  }

  Grid grid_;
  std::array<int, 3> extent_;
  std::ptrdiff_t row_stride_;
  std::ptrdiff_t plane_stride_;
  std::unique_ptr<double[], Release> values_;
};

/// A vector field by its components normal to the faces (velocity, force density, pressure gradient).
struct FaceVector {
  /// A field of zeros on that grid.
  explicit FaceVector(const Grid& grid) : x(grid), y(grid), z(grid) {}
  /// Takes over three components, which must be on one grid.
  FaceVector(Field<FaceX> x_component, Field<FaceY> y_component, Field<FaceZ> z_component)
      : x(std::move(x_component)), y(std::move(y_component)), z(std::move(z_component)) {}

  /// A copy, ghosts included.
  FaceVector clone() const { return {x.clone(), y.clone(), z.clone()}; }
  /// Sets all points and ghosts of the components.
  void fill(double value) {
    x.fill(value);
    y.fill(value);
    z.fill(value);
  }
  const Grid& grid() const { return x.grid(); }  ///< the grid of the components

  /// The components by number, for loops that treat all three alike: Field::points() of each.
  std::array<View, 3> points() { return {x.points(), y.points(), z.points()}; }
  /// The same, to read.
  std::array<ConstView, 3> points() const { return {x.points(), y.points(), z.points()}; }
  /// Field::unknowns() of each component.
  std::array<View, 3> unknowns() { return {x.unknowns(), y.unknowns(), z.unknowns()}; }
  /// The same, to read.
  std::array<ConstView, 3> unknowns() const { return {x.unknowns(), y.unknowns(), z.unknowns()}; }

  Field<FaceX> x;  ///< component along x
  Field<FaceY> y;  ///< component along y
  Field<FaceZ> z;  ///< component along z
};

}  // namespace vesiflow::fluid
