#include "vesicle/conservation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/LU>

#include "check.h"
#include "vesicle/area.h"

namespace vesiflow::vesicle {
namespace {

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
  if (smoothing_degrees > 0) smoothing_.emplace(std::min(smoothing_degrees, grid.latitudes()), grid);
}

double ConservationProjection::independence(const Surface& surface) {
  const ScalarField& h = surface.mean_curvature();
  const double mixed = (h * surface.area_weight()).sum();
  return 1 - mixed * mixed / (surface.area() * (h.square() * surface.area_weight()).sum());
}

/// int g_i g_j dA of the functions g = (1, 2 H).
Eigen::Matrix2d ConservationProjection::gram(const Surface& surface) const {
  const ScalarField& h = surface.mean_curvature();
  const double mixed = 2 * (h * surface.area_weight()).sum();
  const double square = 4 * (h.square() * surface.area_weight()).sum();
  Eigen::Matrix2d matrix;
  matrix << surface.area(), mixed, mixed, square;
  return matrix;
}

/// The a and b for which (a + 2 H b) n adds `missing` to the rates of volume and area.
Eigen::Vector2d ConservationProjection::multipliers(const Surface& surface, const Eigen::Vector2d& missing) const {
  if (!conserved_.area) return {conserved_.volume ? missing[0] / surface.area() : 0, 0};
  const Eigen::Matrix2d matrix = gram(surface);
  if (!conserved_.volume) return {0, missing[1] / matrix(1, 1)};
  constexpr double independent = 1e-10;
  if (!(matrix.determinant() > independent * matrix(0, 0) * matrix(1, 1)))
    throw std::domain_error(
        "volume and area cannot both be kept: the mean curvature is constant to five digits, so every motion along the "
        "normal changes them alike (a sphere); keep the volume alone");
  return matrix.inverse() * missing;
}

void ConservationProjection::add(const Surface& surface, const Eigen::Vector2d& multipliers,
                                 VectorField& motion) const {
  for (int component = 0; component < 3; ++component) {
    motion.col(component) += multipliers[0] * surface.normal().col(component);
    if (multipliers[1] != 0)
      motion.col(component) += 2 * multipliers[1] * surface.mean_curvature() * surface.normal().col(component);
  }
}

/// n and 2 H n, smoothed.
void ConservationProjection::set_directions(const Surface& surface) {
  along_normal_ = surface.normal();
  if (conserved_.area) {
    along_curvature_.resize(along_normal_.rows(), 3);
    for (int component = 0; component < 3; ++component)
      along_curvature_.col(component) = 2 * surface.mean_curvature() * surface.normal().col(component);
  }
  if (!smoothing_) return;
  for (VectorField* direction : {&along_normal_, &along_curvature_}) {
    if (direction->size() == 0) continue;
    smoothing_->analysis(*direction, coefficients_);
    smoothing_->synthesis(coefficients_, *direction);
  }
}

void ConservationProjection::correct_velocity(const Surface& surface, double dt, VectorField& velocity) {
  check_argument(std::isfinite(dt) && dt > 0, "dt", dt, "finite and > 0");
  check_markers(velocity, "velocity", surface.grid().size());
  check_finite(velocity, "a velocity");
  Eigen::Vector2d missing = Eigen::Vector2d::Zero();
  if (conserved_.volume) missing[0] = (*conserved_.volume - surface.volume()) / dt - surface.flux(velocity);
  if (conserved_.area) missing[1] = (*conserved_.area - surface.area()) / dt - area_rate(surface, velocity);
  if (!missing.allFinite())
    throw std::domain_error("the correction of the velocity would not be finite: is the time step too small?");
  add(surface, multipliers(surface, missing), velocity);
}

void ConservationProjection::correct_displacement(const Surface& surface, VectorField& displacement) {
  check_markers(displacement, "displacement", surface.grid().size());
  if (!conserved_.volume && !conserved_.area) return;
  if (!moved_) moved_.emplace(grid_);
  set_directions(surface);
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
    const Eigen::Vector2d by = multipliers(surface, missing);
    displacement += by[0] * along_normal_;
    if (by[1] != 0) displacement += by[1] * along_curvature_;
  }
  throw std::domain_error(
      "corrections of the displacement do not lead to the volume and area that were asked for: the displacement is too "
      "large, or no surface nearby has both");
}

}  // namespace vesiflow::vesicle
