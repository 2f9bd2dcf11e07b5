// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/conservation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/LU>

#include "check.h"
#include "harmonics/check_grid.h"
#include "vesicle/area.h"

namespace vesiflow::vesicle {
namespace {

constexpr int curvature_degrees = 10;

void check_target(const std::optional<double>& target, const char* name) {
  if (target) check_argument(std::isfinite(*target) && *target > 0, name, *target, "finite and > 0");
}

}  // namespace

ConservationProjection::ConservationProjection(const SphereGrid& grid, const Conserved& conserved,
                                               int smoothing_degrees)
    : grid_(grid), conserved_(conserved) {
  check_target(conserved.volume, "target volume");
  check_target(conserved.area, "target area");
  check_argument(smoothing_degrees >= 0, "smoothing_degrees", smoothing_degrees, ">= 0");
  if (conserved.area) curvature_filter_.emplace(std::min(curvature_degrees, grid.latitudes()), grid, 1);
  if (smoothing_degrees > 0) displacement_filter_.emplace(std::min(smoothing_degrees, grid.latitudes()), grid);
}

double ConservationProjection::independence(const Surface& surface) {
  const ScalarField& h = surface.mean_curvature();
  const double mixed = (h * surface.area_weight()).sum();
  return 1 - mixed * mixed / (surface.area() * (h.square() * surface.area_weight()).sum());
}

/// n and F[2 H] n of the surface before the move; the second only if the area is kept.
void ConservationProjection::set_directions(const Surface& surface) {
  along_normal_ = surface.normal();
  if (!conserved_.area) return;
  curvature_ = 2 * surface.mean_curvature();
  curvature_filter_->analysis(curvature_, coefficients_);
  curvature_filter_->synthesis(coefficients_, curvature_);
  along_curvature_ = surface.normal().colwise() * curvature_;
}

/// n and 2 H n cut to the degrees of displacements, in place of those.
void ConservationProjection::smooth_directions(const Surface& surface) {
  if (conserved_.area) along_curvature_ = surface.normal().colwise() * (2 * surface.mean_curvature());
  for (VectorField* direction : {&along_normal_, &along_curvature_}) {
    if (direction->size() == 0) continue;
    displacement_filter_->analysis(*direction, displacement_coefficients_);
    displacement_filter_->synthesis(displacement_coefficients_, *direction);
  }
}

/// What the two directions (columns) do to volume and area (rows).
Eigen::Matrix2d ConservationProjection::rates(const Surface& surface) const {
  const ScalarField& weight = surface.area_weight();
  Eigen::Matrix2d matrix;
  for (int direction : {0, 1}) {
    const VectorField& along = direction == 0 ? along_normal_ : along_curvature_;
    const auto normal = (along * surface.normal()).rowwise().sum();
    matrix(0, direction) = (normal * weight).sum();
    matrix(1, direction) = 2 * (surface.mean_curvature() * normal * weight).sum();
  }
  return matrix;
}

/// The a and b for which a and b times the two directions add `missing` to the rates of volume and area.
Eigen::Vector2d ConservationProjection::multipliers(const Surface& surface, const Eigen::Vector2d& missing) const {
  if (!conserved_.area) return {conserved_.volume ? missing[0] / surface.flux(along_normal_) : 0, 0};
  const Eigen::Matrix2d matrix = rates(surface);
  if (!conserved_.volume) return {0, missing[1] / matrix(1, 1)};
  constexpr double independent = 1e-10;
  if (!(matrix.determinant() > independent * matrix(0, 0) * matrix(1, 1)))
    throw std::domain_error(
        "volume and area cannot both be kept: the mean curvature is constant to five digits, so every motion along the "
        "normal changes them alike (a sphere); keep the volume alone");
  return matrix.inverse() * missing;
}

void ConservationProjection::add(const Eigen::Vector2d& multipliers, VectorField& motion) const {
  motion += multipliers[0] * along_normal_;
  if (multipliers[1] != 0) motion += multipliers[1] * along_curvature_;
}

void ConservationProjection::correct_velocity(const Surface& surface, double dt, VectorField& velocity) {
  check_argument(std::isfinite(dt) && dt > 0, "dt", dt, "finite and > 0");
  check_grid(surface.grid(), "surface", grid_);
  check_markers(velocity, "velocity", grid_.size());
  check_finite(velocity, "a velocity");
  set_directions(surface);
  Eigen::Vector2d missing = Eigen::Vector2d::Zero();
  if (conserved_.volume) missing[0] = (*conserved_.volume - surface.volume()) / dt - surface.flux(velocity);
  if (conserved_.area) missing[1] = (*conserved_.area - surface.area()) / dt - area_rate(surface, velocity);
  if (!missing.allFinite())
    throw std::domain_error("the correction of the velocity would not be finite: is the time step too small?");
  add(multipliers(surface, missing), velocity);
}

void ConservationProjection::remove_rates(const Surface& surface, VectorField& velocity) {
  check_grid(surface.grid(), "surface", grid_);
  check_markers(velocity, "velocity", grid_.size());
  check_finite(velocity, "a velocity");
  if (!conserved_.volume && !conserved_.area) return;
  set_directions(surface);
  if (displacement_filter_) smooth_directions(surface);
  Eigen::Vector2d missing = Eigen::Vector2d::Zero();
  if (conserved_.volume) missing[0] = -surface.flux(velocity);
  if (conserved_.area) missing[1] = -area_rate(surface, velocity);
  add(multipliers(surface, missing), velocity);
}

void ConservationProjection::correct_displacement(const Surface& surface, VectorField& displacement) {
  check_grid(surface.grid(), "surface", grid_);
  check_markers(displacement, "displacement", grid_.size());
  if (!conserved_.volume && !conserved_.area) return;
  if (!moved_) moved_.emplace(grid_);
  set_directions(surface);
  if (displacement_filter_) smooth_directions(surface);
  // The matrix is that of the surface before the move: the error falls by a factor of the size of D in each iteration.
  constexpr int max_iterations = 50;
  constexpr double tolerance = 1e-13;
  constexpr double divergence = 10;
  double smallest_error = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    positions_ = surface.positions() + displacement;
    moved_->update(positions_);
    Eigen::Vector2d missing = Eigen::Vector2d::Zero();
    double error = 0;
    if (conserved_.volume) {
      missing[0] = *conserved_.volume - moved_->volume();
      error = std::max(error, std::abs(missing[0] / *conserved_.volume));
    }
    if (conserved_.area) {
      missing[1] = *conserved_.area - moved_->area();
      error = std::max(error, std::abs(missing[1] / *conserved_.area));
    }
    if (error < tolerance) return;
    if (!(error < divergence * smallest_error)) break;
    smallest_error = std::min(smallest_error, error);
    add(multipliers(surface, missing), displacement);
  }
  throw std::domain_error(
      "corrections of the displacement do not lead to the volume and area that were asked for: the displacement is too "
      "large, or no surface nearby has both");
}

}  // namespace vesiflow::vesicle
