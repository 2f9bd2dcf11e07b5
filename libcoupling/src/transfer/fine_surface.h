// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "transfer/parameter_mesh.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// A surface about one of its points, as far as the way from there to another one needs. What only says how far to go is
/// of single precision: it changes a step by 1e-7 of its length, and steps are short.
struct SurfacePoint {
  Eigen::Array4d position;  ///< X, 0
  Eigen::Array4d normal;    ///< n, outward, 0
  /// The gradient of the direction that names the point, d(s_i)/d(x_j) row by row, then S = grad_s n by xx, yy, zz, xy,
  /// yz, zx, and 0. S is symmetric, and S n = 0.
  Eigen::Array<float, 16, 1> slopes;
};

/// A closed surface and fields on it, on a mesh that is as fine as the fluid's grid: what is looked up at any of its
/// points is interpolated by 6 x 6 points of Lagrange.
class FineSurface {
 public:
  using Four = Eigen::Array4d;
  using Direction = ParameterMesh::Direction;
  using Node = ParameterMesh::Node;
  using Place = ParameterMesh::Place;

  /// Records of four numbers at every node that value() interpolates.
  enum Record {
    position,  ///< X, 0
    normal,    ///< n, outward, 0
    jumps      ///< from here on: those of the caller
  };

  /// \param records of four numbers of the caller
  explicit FineSurface(int records) : own_records_(records) {}

  /// Takes a surface. Its mesh is made finer where nodes would be further apart than `spacing`; that allocates.
  void update(const vesicle::Surface& surface, double spacing);

  /// Sets the records of the caller: field i of the coefficients becomes number `slot[i]` of them, four a record.
  void set(const vesicle::Coefficients& fields, const std::vector<int>& slots);

  const ParameterMesh& mesh() const { return *mesh_; }
  int latitudes() const { return mesh_->latitudes(); }
  int longitudes() const { return mesh_->longitudes(); }
  Eigen::Index nodes() const { return mesh_->grid().size(); }
  Place place_of(const Direction& s) const { return mesh_->place_of(s); }

  /// One of the records at a place, and at a node.
  Four value(const Place& place, int record) const;
  Eigen::Map<const Four> at_node(int i, int j, int record) const {
    return Eigen::Map<const Four>(entry(record, mesh_->in_table(j, i)));
  }
  /// The surface at a place, and at a node.
  SurfacePoint at(const Place& place) const;
  SurfacePoint at(Node node) const;

  /// No two neighbours on the mesh are further apart, also if of each row only one in stride_of_row() nodes is taken.
  double spacing() const { return spacing_; }
  int stride_of_row(int row) const { return stride_of_row_[static_cast<std::size_t>(row)]; }
  /// The box that all nodes are in.
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }

 private:
  static constexpr int form_size = 8;  // of a node: X, n
  static constexpr int slopes_size = 16;

  void make_mesh(int latitudes, int degrees);
  void tabulate_surface();
  void find_strides();

  template <int size>
  Four interpolated(const double* table, const Place& place) const;
  // X and n lie side by side, as who needs one needs the other; of the caller's records one is read at a time.
  const double* entry(int record, std::ptrdiff_t node) const {
    return record < jumps ? form_.data() + form_size * node + 4 * record
                          : jumps_.data() + 4 * (mesh_->table_size() * (record - jumps) + node);
  }

  template <class T>
  using Table = std::vector<T, Eigen::aligned_allocator<T>>;

  int own_records_;
  int degrees_ = 0;
  double spacing_ = 0.0;
  Eigen::Vector3d lower_, upper_;
  std::optional<ParameterMesh> mesh_;
  std::optional<vesicle::SphericalHarmonics> harmonics_;
  std::optional<vesicle::SurfaceGeometry> geometry_;
  std::vector<int> stride_of_row_;
  Table<double> form_;
  Table<float> slopes_;
  Table<double> jumps_;  // record by record
  vesicle::Coefficients padded_;
  Eigen::ArrayXXd values_, fields_;  // at the nodes: X, and what set() was given
};

template <int size>
FineSurface::Four FineSurface::interpolated(const double* table, const Place& place) const {
  constexpr int width = ParameterMesh::width;
  const ParameterMesh::Weights weights = mesh_->weights(place);
  const double* at = table + size * mesh_->first_in_table(place);
  Four sum = Four::Zero();
  for (int j = 0; j < width; ++j, at += size * mesh_->row_size()) {
    Four row = Four::Zero();
    for (int i = 0; i < width; ++i) row += weights.of_column[i] * Eigen::Map<const Four>(at + size * i);
    sum += weights.of_row[j] * row;
  }
  return sum;
}

inline FineSurface::Four FineSurface::value(const Place& place, int record) const {
  return record < jumps ? interpolated<form_size>(entry(record, 0), place) : interpolated<4>(entry(record, 0), place);
}

inline SurfacePoint FineSurface::at(Node node) const {
  const std::ptrdiff_t number = mesh_->in_table(node.row, node.column);
  return {Eigen::Map<const Four>(entry(position, number)), Eigen::Map<const Four>(entry(normal, number)),
          Eigen::Map<const Eigen::Array<float, slopes_size, 1>>(slopes_.data() + slopes_size * number)};
}

inline SurfacePoint FineSurface::at(const Place& place) const {
  using Slopes = Eigen::Array<float, slopes_size, 1>;
  constexpr int width = ParameterMesh::width;
  const ParameterMesh::Weights weights = mesh_->weights(place);
  const Eigen::Array<float, 8, 1> of_row = weights.of_row.cast<float>(), of_column = weights.of_column.cast<float>();
  const std::ptrdiff_t first = mesh_->first_in_table(place);
  const double* form = entry(position, first);
  const float* slope = slopes_.data() + slopes_size * first;
  Four x = Four::Zero(), n = Four::Zero();
  Slopes s = Slopes::Zero();
  for (int j = 0; j < width; ++j) {
    Four row_x = Four::Zero(), row_n = Four::Zero();
    Slopes row_s = Slopes::Zero();
    for (int i = 0; i < width; ++i) {
      row_x += weights.of_column[i] * Eigen::Map<const Four>(form + form_size * i);
      row_n += weights.of_column[i] * Eigen::Map<const Four>(form + form_size * i + 4);
      row_s += of_column[i] * Eigen::Map<const Slopes>(slope + slopes_size * i);
    }
    x += weights.of_row[j] * row_x;
    n += weights.of_row[j] * row_n;
    s += of_row[j] * row_s;
    form += form_size * mesh_->row_size();
    slope += slopes_size * mesh_->row_size();
  }
  return {x, n, s};
}

}  // namespace vesiflow::coupling
