// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/surface.h"

#include <limits>

#include "check.h"
#include "surface/checked_grid.h"

namespace vesiflow::vesicle {
namespace {

constexpr int projector_fields = 6;  // distinct entries of a symmetric 3 x 3 matrix

}  // namespace

/// Fields in flight inside the differential operators.
struct Surface::Work {
  explicit Work(Eigen::Index size)
      : values(size, projector_fields), theta(size, projector_fields), phi(size, projector_fields), divergence(size) {}

  Coefficients coefficients;
  Eigen::ArrayXXd values, theta, phi;
  ScalarField divergence;
};

Surface::Surface(int latitudes) : Surface(SphereGrid(latitudes)) {}

Surface::Surface(const SphereGrid& grid)
    : grid_(checked(grid)),
      harmonics_(grid_.latitudes(), grid_, projector_fields),
      geometry_(grid_),
      area_weight_(grid_.size()),
      work_(std::make_unique<Work>(grid_.size())) {}
Surface::~Surface() = default;
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;

void Surface::update(const VectorField& positions, GeometryDetail detail) {
  check_markers(positions, "positions", grid_.size());
  check_finite(positions, "a position");
  area_ = volume_ = std::numeric_limits<double>::quiet_NaN();  // what remains if the mesh is degenerate
  positions_ = positions;
  harmonics_.analysis(positions_, coefficients_);
  geometry_.update(harmonics_, coefficients_, detail);
  for (int j = 0; j < grid_.latitudes(); ++j) {
    const Eigen::Index ring = grid_.index(0, j);
    area_weight_.segment(ring, grid_.longitudes()) =
        area_element().segment(ring, grid_.longitudes()) * grid_.parameter_measure()[j];
  }
  area_ = area_weight_.sum();
  volume_ = flux(positions_) / 3;
}

const SurfaceGeometry& Surface::geometry_with_curvature() const {
  if (!geometry_.has_curvature()) geometry_.add_curvature(harmonics_, coefficients_);
  return geometry_;
}

double Surface::integral(const ScalarField& field) const {
  check_markers(field, "field", grid_.size());
  return (field * area_weight_).sum();
}

Vector3 Surface::integral(const VectorField& field) const {
  check_markers(field, "field", grid_.size());
  Vector3 sums;
  for (int component = 0; component < 3; ++component) sums[component] = (field.col(component) * area_weight_).sum();
  return sums;
}

double Surface::flux(const VectorField& field) const {
  check_markers(field, "field", grid_.size());
  const VectorField& n = normal();
  return ((field.col(0) * n.col(0) + field.col(1) * n.col(1) + field.col(2) * n.col(2)) * area_weight_).sum();
}

void Surface::gradient(const ScalarField& scalar, VectorField& result) const {
  check_markers(scalar, "scalar", grid_.size());
  result.resize(grid_.size(), 3);
  harmonics_.analysis(scalar, work_->coefficients);
  auto theta = work_->theta.leftCols(1);
  auto phi = work_->phi.leftCols(1);
  harmonics_.gradient(work_->coefficients, theta, phi);
  for (int component = 0; component < 3; ++component)
    result.col(component) =
        theta.col(0) * geometry_.dual_theta().col(component) + phi.col(0) * geometry_.dual_phi().col(component);
}

void Surface::divergence(const VectorField& vector, ScalarField& result) const {
  check_markers(vector, "vector", grid_.size());
  result.resize(grid_.size());
  harmonics_.analysis(vector, work_->coefficients);
  auto theta = work_->theta.leftCols(3);
  auto phi = work_->phi.leftCols(3);
  harmonics_.gradient(work_->coefficients, theta, phi);
  const VectorField& a = geometry_.dual_theta();
  const VectorField& b = geometry_.dual_phi();
  result = theta.col(0) * a.col(0) + theta.col(1) * a.col(1) + theta.col(2) * a.col(2) + phi.col(0) * b.col(0) +
           phi.col(1) * b.col(1) + phi.col(2) * b.col(2);
}

double Surface::max_divergence(const VectorField& vector) const {
  check_markers(vector, "vector", grid_.size());
  check_finite(vector, "a vector");  // the largest of an array may pass over a NaN
  divergence(vector, work_->divergence);
  return work_->divergence.abs().maxCoeff();
}

void Surface::projector_divergence(const ScalarField& scalar, VectorField& result) const {
  check_markers(scalar, "scalar", grid_.size());
  result.resize(grid_.size(), 3);
  constexpr int entry[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  const VectorField& n = normal();
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column)
      work_->values.col(entry[row][column]) = scalar * ((row == column ? 1.0 : 0.0) - n.col(row) * n.col(column));
  harmonics_.analysis(work_->values, work_->coefficients);
  harmonics_.gradient(work_->coefficients, work_->theta, work_->phi);
  const Eigen::ArrayXXd& theta = work_->theta;
  const Eigen::ArrayXXd& phi = work_->phi;
  const VectorField& a = geometry_.dual_theta();
  const VectorField& b = geometry_.dual_phi();
  for (int row = 0; row < 3; ++row) {
    const int* e = entry[row];
    result.col(row) = theta.col(e[0]) * a.col(0) + theta.col(e[1]) * a.col(1) + theta.col(e[2]) * a.col(2) +
                      phi.col(e[0]) * b.col(0) + phi.col(e[1]) * b.col(1) + phi.col(e[2]) * b.col(2);
  }
}

}  // namespace vesiflow::vesicle
