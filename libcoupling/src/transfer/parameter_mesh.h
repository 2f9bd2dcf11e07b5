// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vesicle/sphere_grid.h"

namespace vesiflow::coupling {

/// A mesh of Gauss colatitudes on the sphere of parameters of a closed surface, for interpolation by 6 x 6 points of
/// Lagrange: continued by a margin across the poles and all around, so that every point is inside of six rows and
/// columns.
///
/// Points are named by their direction, a unit vector, in which the poles are like all other points.
class ParameterMesh {
 public:
  using Direction = Eigen::Vector3d;

  struct Node {
    int row;     ///< 0 .. latitudes() - 1, from the north pole
    int column;  ///< 0 .. longitudes() - 1
  };

  /// A point between nodes.
  struct Place {
    int row;             ///< the one above it, -1 .. latitudes() - 1
    int column;          ///< the one west of it
    double below, east;  ///< how far it is from there, in rows (of their mean distance) and columns
  };

  /// The weights of the nodes of six rows and of six columns, and two zeros.
  struct Weights {
    Eigen::Array<double, 8, 1> of_row, of_column;
  };
  static constexpr int width = 6;

  /// Six rows on either side of a pole are different rows.
  static constexpr int fewest_latitudes = 8;

  /// \param latitudes at least fewest_latitudes
  explicit ParameterMesh(int latitudes);

  const vesicle::SphereGrid& grid() const { return grid_; }
  int latitudes() const { return grid_.latitudes(); }
  int longitudes() const { return grid_.longitudes(); }

  Direction direction_of(Node node) const {
    const Trigonometry& theta = of_row(node.row);
    const Trigonometry& phi = of_column(node.column);
    return {theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine};
  }

  /// The derivatives of the direction by colatitude and longitude.
  struct Tangents {
    Eigen::Vector3d theta, phi;
  };
  Tangents tangents_at(Node node) const {
    const Trigonometry& theta = of_row(node.row);
    const Trigonometry& phi = of_column(node.column);
    return {{theta.cosine * phi.cosine, theta.cosine * phi.sine, -theta.sine},
            {-theta.sine * phi.sine, theta.sine * phi.cosine, 0.0}};
  }

  /// Cosines and sines of colatitude and longitude.
  struct Angles {
    double cos_theta, sin_theta, cos_phi, sin_phi;
  };
  Angles angles_of(Node node) const {
    const Trigonometry& theta = of_row(node.row);
    const Trigonometry& phi = of_column(node.column);
    return {theta.cosine, theta.sine, phi.cosine, phi.sine};
  }

  /// The place of a direction, which need not be of unit length.
  Place place_of(const Direction& s) const {
    return place_at(std::atan2(std::sqrt(s[0] * s[0] + s[1] * s[1]), s[2]),
                    columns_per_angle_ * std::atan2(s[1], s[0]));
  }
  /// The place with this colatitude and longitude, seen from a node; together not beyond a pole, less than a whole turn.
  Place place_at(Node node, double theta, double phi) const {
    return place_at(colatitude(node.row) + theta, node.column + columns_per_angle_ * phi);
  }

  Weights weights(const Place& place) const {
    const Polynomials& of_row = of_rows_[static_cast<std::size_t>(place.row + 1)];
    Weights weights;
    weights.of_row = of_row[0];
    weights.of_column = of_column_[0];
    for (std::size_t power = 1; power < width; ++power) {
      weights.of_row = weights.of_row * place.below + of_row[power];
      weights.of_column = weights.of_column * place.east + of_column_[power];
    }
    return weights;
  }

  /// Tables on the mesh have its nodes row by row with the margins; these are the places of nodes in them.
  std::ptrdiff_t table_size() const { return std::ptrdiff_t{row_size()} * (latitudes() + 2 * margin); }
  int row_size() const { return longitudes() + 2 * margin; }
  std::ptrdiff_t in_table(int row, int column) const {
    return std::ptrdiff_t{row + margin} * row_size() + (column + margin);
  }
  /// The first of the nodes that the weights of a place are for.
  std::ptrdiff_t first_in_table(const Place& place) const { return in_table(place.row - 2, place.column - 2); }

  /// Copies what is in the margins of a table from its nodes.
  template <class T>
  void fill_margins(T* table) const;

 private:
  static constexpr int margin = 3;
  struct Trigonometry {
    double cosine, sine;
  };
  // Of eight weights, coefficients of the highest power first.
  using Polynomials = std::array<Eigen::Array<double, 8, 1>, width>;
  static Polynomials lagrange_polynomials(const std::array<double, width>& nodes);

  const Trigonometry& of_row(int row) const { return row_angles_[static_cast<std::size_t>(row)]; }
  const Trigonometry& of_column(int column) const { return column_angles_[static_cast<std::size_t>(column)]; }
  double colatitude(int row) const { return colatitude_[static_cast<std::size_t>(row + margin)]; }
  Place place_at(double theta, double column) const;

  vesicle::SphereGrid grid_;
  double rows_per_angle_, columns_per_angle_;
  std::vector<double> colatitude_;  // of rows, margins counted
  std::vector<Trigonometry> row_angles_, column_angles_;
  std::vector<Polynomials, Eigen::aligned_allocator<Polynomials>> of_rows_;  // from row -1 on
  Polynomials of_column_;
};

inline ParameterMesh::Place ParameterMesh::place_at(double theta, double column) const {
  Place place;
  // Gauss colatitudes are (j + 3/4) pi / (N + 1/2) but for a small part of their distance.
  place.row = static_cast<int>(theta * rows_per_angle_ + 0.25) - 1;
  while (place.row > -1 && colatitude(place.row) > theta) --place.row;
  while (place.row < latitudes() - 1 && colatitude(place.row + 1) <= theta) ++place.row;
  place.below = rows_per_angle_ * (theta - colatitude(place.row));
  if (column < 0.0) column += longitudes();
  if (column >= longitudes()) column -= longitudes();
  place.column = std::min(static_cast<int>(column), longitudes() - 1);
  place.east = column - place.column;
  return place;
}

template <class T>
void ParameterMesh::fill_margins(T* table) const {
  const int n = latitudes(), m = longitudes();
  const auto copy = [&](int row, int column, int from_row, int from_column, int count) {
    std::copy_n(table + in_table(from_row, from_column), count, table + in_table(row, column));
  };
  for (int j = -margin; j < n + margin; ++j) {
    // Across a pole lies the meridian on the other side.
    const int from = j < 0 ? -1 - j : j >= n ? 2 * n - 1 - j : j;
    if (from != j) {
      copy(j, 0, from, m / 2, m / 2);
      copy(j, m / 2, from, 0, m / 2);
    }
    copy(j, -margin, j, m - margin, margin);
    copy(j, m, j, 0, margin);
  }
}

}  // namespace vesiflow::coupling
