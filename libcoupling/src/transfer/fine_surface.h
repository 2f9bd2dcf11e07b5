// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "transfer/parameter_mesh.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// A surface about one of its points, as far as the way from there to another one needs. What only says how far to go is
/// of single precision: it changes a step by 1e-7 of its length, and steps are short.
struct SurfacePoint {
  Eigen::Array<double, 8, 1> position_and_normal;  ///< X, 0, n (outward), 0
  auto position() const { return position_and_normal.head<4>(); }
  auto normal() const { return position_and_normal.tail<4>(); }
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

  /// Takes a surface. Neighbours on its mesh are no further apart than `spacing`. The mesh depends on the surface alone,
  /// not on those before, as a run that is restarted knows none; one of a new size allocates.
  void update(const vesicle::Surface& surface, double spacing);

  /// Sets the records of the caller: field i of the coefficients becomes number `slot[i]` of them, four a record.
  void set(const vesicle::Coefficients& fields, const std::vector<int>& slots);

  const ParameterMesh& mesh() const { return on_mesh_->mesh; }
  int latitudes() const { return mesh().latitudes(); }
  int longitudes() const { return mesh().longitudes(); }
  Eigen::Index nodes() const { return mesh().grid().size(); }
  Place place_of(const Direction& s) const { return mesh().place_of(s); }

  /// One of the records at a place, and at a node.
  Four value(const Place& place, int record) const;
  Four at_node(int column, int row, int record) const;
  /// The surface at a place, and at a node.
  SurfacePoint at(const Place& place) const;
  const SurfacePoint& at(Node node) const {
    return surface_[static_cast<std::size_t>(mesh().in_table(node.row, node.column))];
  }

  /// No two neighbours on the mesh are further apart, nor two of sparse_nodes(), which lack some of the rows next to the
  /// poles. Of a surface that is symmetric about a plane through its poles and column 0, across that or across its axis,
  /// these are symmetric.
  double spacing() const { return spacing_; }
  const std::vector<Node>& sparse_nodes() const { return sparse_nodes_; }
  /// The box that all nodes are in.
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }

 private:
  template <class T>
  using Table = std::vector<T, Eigen::aligned_allocator<T>>;

  /// A mesh with what is computed on it.
  struct OnMesh {
    OnMesh(int latitudes, int degrees) : mesh(latitudes), harmonics(degrees, mesh.grid(), 3), geometry(mesh.grid()) {}
    ParameterMesh mesh;
    vesicle::SphericalHarmonics harmonics;
    vesicle::SurfaceGeometry geometry;
  };

  void choose_mesh(int latitudes, int degrees);
  void tabulate_surface();
  void find_sparse_nodes();

  const Four* table_of(int record) const { return jumps_.data() + mesh().table_size() * (record - jumps); }
  // The weighted sum of what `value` is of the nodes of a place.
  template <class T, class Value>
  Four interpolated(const Place& place, const T* table, const Value& value) const;

  int own_records_;
  double spacing_ = 0.0;
  Eigen::Vector3d lower_, upper_;
  std::vector<std::unique_ptr<OnMesh>> meshes_;  // that have been in use
  OnMesh* on_mesh_ = nullptr;
  std::vector<Node> sparse_nodes_;
  Table<SurfacePoint> surface_;
  Table<Four> jumps_;  // record by record
  vesicle::Coefficients padded_;
  Eigen::ArrayXXd values_, fields_;  // at the nodes: X, and what set() was given
};

template <class T, class Value>
FineSurface::Four FineSurface::interpolated(const Place& place, const T* table, const Value& value) const {
  const ParameterMesh::Weights weights = mesh().weights(place);
  const T* node = table + mesh().first_in_table(place);
  Four sum = Four::Zero();
  for (int j = 0; j < ParameterMesh::width; ++j, node += mesh().row_size()) {
    Four row = Four::Zero();
    for (int i = 0; i < ParameterMesh::width; ++i) row += weights.of_column[i] * value(node[i]);
    sum += weights.of_row[j] * row;
  }
  return sum;
}

inline FineSurface::Four FineSurface::value(const Place& place, int record) const {
  if (record == position)
    return interpolated(place, surface_.data(), [](const SurfacePoint& p) { return p.position(); });
  if (record == normal) return interpolated(place, surface_.data(), [](const SurfacePoint& p) { return p.normal(); });
  return interpolated(place, table_of(record), [](const Four& four) -> const Four& { return four; });
}

}  // namespace vesiflow::coupling
