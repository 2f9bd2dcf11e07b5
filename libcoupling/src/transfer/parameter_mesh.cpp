// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/parameter_mesh.h"

#include <numbers>

namespace vesiflow::coupling {

ParameterMesh::ParameterMesh(int latitudes)
    : grid_(latitudes),
      rows_per_angle_((latitudes + 0.5) / std::numbers::pi),
      columns_per_angle_(1.0 / grid_.longitude_spacing()) {
  const auto& theta = grid_.colatitude();
  for (int j = -margin; j < latitudes + margin; ++j)
    colatitude_.push_back(j < 0           ? -theta[-1 - j]
                          : j < latitudes ? theta[j]
                                          : 2.0 * std::numbers::pi - theta[2 * latitudes - 1 - j]);
  for (int j = 0; j < latitudes; ++j) row_angles_.push_back({grid_.cos_colatitude()[j], grid_.sin_colatitude()[j]});
  for (int i = 0; i < longitudes(); ++i)
    column_angles_.push_back({std::cos(grid_.longitude(i)), std::sin(grid_.longitude(i))});

  for (int row = -1; row < latitudes; ++row) {
    std::array<double, width> nodes;
    for (int i = 0; i < width; ++i)
      nodes[static_cast<std::size_t>(i)] = rows_per_angle_ * (colatitude(row - 2 + i) - colatitude(row));
    of_rows_.push_back(lagrange_polynomials(nodes));
  }
  of_column_ = lagrange_polynomials({-2.0, -1.0, 0.0, 1.0, 2.0, 3.0});
}

ParameterMesh::Polynomials ParameterMesh::lagrange_polynomials(const std::array<double, width>& nodes) {
  Polynomials result;
  for (auto& coefficients : result) coefficients.setZero();
  for (std::size_t i = 0; i < width; ++i) {
    // By powers, the lowest first, of one factor (x - x_j) / (x_i - x_j) after the other.
    std::array<double, width> product{1.0};
    for (std::size_t j = 0, degree = 0; j < width; ++j) {
      if (j == i) continue;
      ++degree;
      const double scale = 1.0 / (nodes[i] - nodes[j]);
      for (std::size_t k = degree; k > 0; --k) product[k] = scale * (product[k - 1] - nodes[j] * product[k]);
      product[0] *= -scale * nodes[j];
    }
    for (std::size_t k = 0; k < width; ++k) result[width - 1 - k][static_cast<Eigen::Index>(i)] = product[k];
  }
  return result;
}

}  // namespace vesiflow::coupling
