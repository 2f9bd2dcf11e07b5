// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fluid/grid.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// A closed surface and fields on it, on a mesh that is as fine as the fluid's grid: what is looked up at any of its
/// points is interpolated by 6 x 6 points of Lagrange. The mesh is one of Gauss colatitudes, continued across the
/// poles, so that every point of the surface is inside of six rows.
///
/// Points are named by their direction on the sphere of parameters, a unit vector, in which the poles are like all
/// other points.
class FineSurface {
 public:
  using Four = Eigen::Array4d;
  using Direction = Eigen::Vector3d;

  /// Of what is interpolated; each is a record of four numbers at every node.
  enum Record {
    position,               ///< X
    normal,                 ///< n, outward
    direction,              ///< three rows of grad_s of the direction, d(s_i)/d(x_j)
    shape = direction + 3,  ///< S = grad_s n: xx, yy, zz
    shape_mixed,            ///< xy, yz, zx
    jumps                   ///< from here on: those of the caller
  };

  /// Where the interpolation of a point reads, and its weights.
  struct Place {
    std::ptrdiff_t first;  // node
    std::array<double, 6> theta, phi;
  };

  /// \param records of four numbers of the caller, after those of the surface
  explicit FineSurface(int records) : own_records_(records) {}

  /// Takes a surface. Its mesh is made finer where nodes would be further apart than `spacing`; that allocates.
  void update(const vesicle::Surface& surface, double spacing);

  /// Sets the records of the caller: field i of the coefficients becomes number `slot[i]` of them, four a record.
  void set(const vesicle::Coefficients& fields, const std::vector<int>& slots);

  Place place_of(const Direction& s) const;
  Four value(const Place& place, int record) const;

  Eigen::Index nodes() const { return grid_->size(); }
  int latitudes() const { return grid_->latitudes(); }
  int longitudes() const { return grid_->longitudes(); }
  Eigen::Map<const Four> at_node(int i, int j, int record) const { return Eigen::Map<const Four>(entry(j, i, record)); }
  Direction direction_of_node(int i, int j) const;

 private:
  static constexpr int margin = 3;
  int records() const { return jumps + own_records_; }
  // Of row -margin .. latitudes + margin - 1 and column -margin .. longitudes + margin - 1.
  std::size_t offset(int row, int column, int record) const {
    return 4 * (static_cast<std::size_t>(record) * plane_ +
                static_cast<std::size_t>(row + margin) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(column + margin));
  }
  const double* entry(int row, int column, int record) const { return table_.data() + offset(row, column, record); }
  double* entry(int row, int column, int record) { return table_.data() + offset(row, column, record); }
  void make_mesh(int latitudes, int degrees);
  void continue_across_edges(int first_record, int last_record);

  int own_records_;
  int degrees_ = 0;
  std::optional<vesicle::SphereGrid> grid_;
  std::optional<vesicle::SphericalHarmonics> harmonics_;
  std::optional<vesicle::SurfaceGeometry> geometry_;
  std::size_t plane_ = 0;  // nodes of a record, margins included
  int columns_ = 0;
  std::vector<double, Eigen::aligned_allocator<double>> table_;
  std::vector<double> colatitude_;              // of rows, margins included
  std::vector<std::array<double, 6>> inverse_;  // of the products of Lagrange's denominators, by first row
  vesicle::Coefficients padded_;
  Eigen::ArrayXXd values_;
};

}  // namespace vesiflow::coupling
