// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_control.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "check.h"
#include "harmonics/check_grid.h"
#include "surface/columns.h"

namespace vesiflow::vesicle {
namespace {

/// result = (a . n) n + b - (b . n) n: the normal part of a and the tangential part of b. result may be a or
/// b.
void combine(const VectorField& normal, const VectorField& a, const VectorField& b, VectorField& result) {
  const ConstColumns n(normal), u(a), v(b);
  const Columns r(result);
  const Eigen::Index size = normal.rows();
#pragma GCC ivdep
  for (Eigen::Index k = 0; k < size; ++k) {
    const double excess = (u.x[k] - v.x[k]) * n.x[k] + (u.y[k] - v.y[k]) * n.y[k] + (u.z[k] - v.z[k]) * n.z[k];
    r.x[k] = v.x[k] + excess * n.x[k];
    r.y[k] = v.y[k] + excess * n.y[k];
    r.z[k] = v.z[k] + excess * n.z[k];
  }
}

int checked_degrees(int degrees, const char* name, int latitudes) {
  check_argument(degrees >= 1, name, degrees, ">= 1");
  return std::min(degrees, latitudes);
}

}  // namespace

MeshFilter::MeshFilter(const SphereGrid& grid, FilterOrder order, int normal_degrees, int tangential_degrees)
    : order_(order),
      normal_harmonics_(checked_degrees(normal_degrees, "normal_degrees", grid.latitudes()), grid),
      tangential_harmonics_(checked_degrees(tangential_degrees, "tangential_degrees", grid.latitudes()), grid),
      part_(grid.size(), 3) {}

void MeshFilter::apply(const Surface& surface, const VectorField& velocity, VectorField& filtered) {
  check_markers(velocity, "velocity", part_.rows());
  check_grid(surface.grid(), "surface", normal_harmonics_.grid());
  check_finite(velocity, "a velocity");
  filtered.resize(part_.rows(), 3);
  if (order_ == FilterOrder::velocity_first)
    filter_velocity(surface.normal(), velocity, filtered);
  else
    filter_components(surface.normal(), velocity, filtered);
}

void MeshFilter::filter_velocity(const VectorField& normal, const VectorField& velocity, VectorField& filtered) {
  // One analysis serves both filters: each transform reads the degrees it keeps.
  const bool normal_has_more = normal_harmonics_.degrees() >= tangential_harmonics_.degrees();
  (normal_has_more ? normal_harmonics_ : tangential_harmonics_).analysis(velocity, coefficients_);
  normal_harmonics_.synthesis(coefficients_, filtered);
  tangential_harmonics_.synthesis(coefficients_, part_);
  combine(normal, filtered, part_, filtered);
}

void MeshFilter::filter_components(const VectorField& normal, const VectorField& velocity, VectorField& filtered) {
  const auto normal_speed = (velocity * normal).rowwise().sum();
  for (int component = 0; component < 3; ++component) part_.col(component) = normal_speed * normal.col(component);
  filtered = velocity - part_;
  tangential_harmonics_.analysis(filtered, coefficients_);
  tangential_harmonics_.synthesis(coefficients_, filtered);
  normal_harmonics_.analysis(part_, coefficients_);
  normal_harmonics_.synthesis(coefficients_, part_);
  filtered += part_;
}

TargetAreaUpdate::TargetAreaUpdate(const SphereGrid& grid, SlipReference reference)
    : grid_(grid),
      coefficients_(grid.latitudes(), 3),
      slip_(grid.size(), 3),
      normal_slip_(grid.size()),
      slip_divergence_(grid.size()) {
  if (reference == SlipReference::dealiased) dealiasing_.emplace(two_thirds_degrees(grid.latitudes()), grid);
}

void TargetAreaUpdate::apply(const Surface& surface, const VectorField& velocity, const VectorField& filtered,
                             double dt, double total_area, ScalarField& target_areas) {
  const Eigen::Index markers = grid_.size();
  check_grid(surface.grid(), "surface", grid_);
  check_markers(velocity, "velocity", markers);
  check_markers(filtered, "filtered", markers);
  check_markers(target_areas, "target_areas", markers);
  slip_ = velocity;
  if (dealiasing_) {
    dealiasing_->analysis(velocity, coefficients_);
    dealiasing_->synthesis(coefficients_, slip_);
  }
  slip_ = filtered - slip_;
  normal_slip_ = (slip_ * surface.normal()).rowwise().sum();
  for (int component = 0; component < 3; ++component)
    slip_.col(component) -= normal_slip_ * surface.normal().col(component);
  surface.divergence(slip_, slip_divergence_);
  slip_divergence_ = target_areas * (dt * slip_divergence_).exp();
  const double scale = total_area / slip_divergence_.sum();
  if (!(std::isfinite(scale) && scale * slip_divergence_.minCoeff() > 0))
    throw std::domain_error(
        "the target areas would not all be finite and > 0: is the velocity finite, and is the time step small enough?");
  target_areas = scale * slip_divergence_;
}

}  // namespace vesiflow::vesicle
