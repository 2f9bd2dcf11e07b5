// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/redistribution.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "check.h"
#include "harmonics/check_grid.h"

namespace vesiflow::vesicle {
namespace {

constexpr int max_iterations = 30;
constexpr int conjugate_gradient_steps = 12;
constexpr double least_step_gain = 0.02;  // of a Gauss-Newton step, as a fraction of E; less is not worth another
constexpr double least_total_gain = 0.1;
/// Of volume and area, beyond which the surface was not resolved: as X o y it would be another one.
constexpr double largest_shape_change = 0.01;
constexpr double longest_step = 0.3;  // of y in one step, radians
constexpr int halvings = 6;
/// Keeps w finite where E does not see it; small beside a_2 = 24.
constexpr double damping = 1;

VectorField unit_sphere(const SphereGrid& grid) {
  VectorField x(grid.size(), 3);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      x.row(grid.index(i, j)) << grid.sin_colatitude()[j] * std::cos(grid.longitude(i)),
          grid.sin_colatitude()[j] * std::sin(grid.longitude(i)), grid.cos_colatitude()[j];
  return x;
}

void normalise(VectorField& field) {
  const ScalarField length = field.square().rowwise().sum().sqrt();
  field.colwise() /= length;
}

}  // namespace

MeshRedistribution::MeshRedistribution(int latitudes, int kept_degrees)
    : surface_(latitudes),
      smoothing_(two_thirds_degrees(latitudes), surface_.grid()),
      evaluation_(latitudes),
      descent_({.damping = damping}) {
  check_argument(kept_degrees >= 0 && kept_degrees <= latitudes, "kept_degrees", kept_degrees, "in [0, latitudes]");
  if (kept_degrees > 0 && kept_degrees < latitudes) truncation_.emplace(kept_degrees, surface_.grid());
  const Eigen::Index markers = surface_.grid().size();
  for (VectorField* field : {&map_, &map_theta_, &map_phi_, &trial_map_, &trial_positions_, &displacement_, &residual_,
                             &direction_, &product_, &preconditioned_, &map_step_, &old_positions_})
    *field = VectorField::Zero(markers, 3);
  map_ = unit_sphere(surface_.grid());
}

RedistributionReport MeshRedistribution::redistribute(const Surface& surface) {
  check_grid(surface.grid(), "surface", surface_.grid());
  map_ = unit_sphere(surface_.grid());
  surface_.update(surface.positions());
  const Coefficients& original = surface.position_coefficients();
  RedistributionReport report;
  report.before = mesh_quality(surface);
  report.energy_before = energy();
  double last = report.energy_before;
  // E of positions that are a linear image of the sphere but for their rounding.
  constexpr double rounding = 1e-14;
  const int highest = original.degrees() - 1;
  const double round_off = rounding * rounding * mesh_energy_weight(highest) * original.energy(1, highest + 1);
  while (report.iterations < max_iterations && last > round_off) {
    find_displacement();
    pull_back();
    if (!move(original)) break;
    ++report.iterations;
    const double now = energy();
    const bool worth_it = now < (1 - least_step_gain) * last;
    last = now;
    if (!worth_it) break;
  }
  const auto kept = [](double after, double before) {
    return std::abs(after - before) < largest_shape_change * std::abs(before);
  };
  report.moved = last < (1 - least_total_gain) * report.energy_before && kept(surface_.volume(), surface.volume()) &&
                 kept(surface_.area(), surface.area());
  if (report.moved) {
    report.truncation = truncate();
  } else {
    last = report.energy_before;
    map_ = unit_sphere(surface_.grid());
    surface_.update(surface.positions());
  }
  report.energy_after = last;
  report.after = mesh_quality(surface_);
  return report;
}

double MeshRedistribution::inner(const VectorField& a, const VectorField& b) const {
  const SphereGrid& grid = surface_.grid();
  double sum = 0;
  for (int j = 0; j < grid.latitudes(); ++j) {
    const auto ring = Eigen::seqN(grid.index(0, j), grid.longitudes());
    sum += grid.weight()[j] * (a(ring, Eigen::all) * b(ring, Eigen::all)).sum();
  }
  return sum * grid.longitude_spacing();
}

void MeshRedistribution::find_displacement() {
  const SphericalHarmonics& harmonics = surface_.harmonics();
  displacement_.setZero();
  descent_.force(harmonics, surface_, residual_);
  double old = 0;
  for (int step = 0; step < conjugate_gradient_steps; ++step) {
    descent_.precondition(harmonics, surface_, residual_, preconditioned_);
    const double now = inner(residual_, preconditioned_);
    if (!(now > 0)) break;
    if (step == 0)
      direction_ = preconditioned_;
    else
      direction_ = preconditioned_ + (now / old) * direction_;
    old = now;
    descent_.apply_second_derivative(harmonics, surface_, direction_, product_);
    const double length = now / inner(direction_, product_);
    displacement_ += length * direction_;
    residual_ -= length * product_;
  }
}

void MeshRedistribution::pull_back() {
  surface_.harmonics().analysis(map_, coefficients_);
  surface_.harmonics().gradient(coefficients_, map_theta_, map_phi_);
  const ScalarField theta = (displacement_ * surface_.geometry().dual_theta()).rowwise().sum();
  const ScalarField phi = (displacement_ * surface_.geometry().dual_phi()).rowwise().sum();
  for (int component = 0; component < 3; ++component)
    map_step_.col(component) = theta * map_theta_.col(component) + phi * map_phi_.col(component);
  smoothing_.analysis(map_step_, coefficients_);
  smoothing_.synthesis(coefficients_, map_step_);
}

bool MeshRedistribution::is_one_to_one(const VectorField& map) {
  surface_.harmonics().analysis(map, coefficients_);
  surface_.harmonics().gradient(coefficients_, map_theta_, map_phi_);
  for (Eigen::Index k = 0; k < map.rows(); ++k) {
    const Vector3 theta = map_theta_.row(k).matrix().transpose(), phi = map_phi_.row(k).matrix().transpose();
    if (!(theta.cross(phi).dot(map.row(k).matrix().transpose()) > 0)) return false;
  }
  return true;
}

bool MeshRedistribution::move(const Coefficients& original) {
  const double before = energy();
  const double longest = std::sqrt(map_step_.square().rowwise().sum().maxCoeff());
  double step = std::min(1.0, longest_step / longest);
  old_positions_ = surface_.positions();
  for (int k = 0; k <= halvings; ++k, step /= 2) {
    trial_map_ = map_ + step * map_step_;
    normalise(trial_map_);
    if (!is_one_to_one(trial_map_)) continue;
    evaluation_.values_at(original, trial_map_, trial_positions_);
    surface_.update(trial_positions_);
    if (energy() < before) {
      map_ = trial_map_;
      return true;
    }
  }
  surface_.update(old_positions_);
  return false;
}

double MeshRedistribution::truncate() {
  if (!truncation_) return 0;
  trial_positions_ = surface_.positions();
  truncation_->analysis(trial_positions_, coefficients_);
  truncation_->synthesis(coefficients_, trial_positions_);
  const double distance = std::sqrt((trial_positions_ - surface_.positions()).square().rowwise().sum().maxCoeff());
  surface_.update(trial_positions_);
  return distance;
}

void MeshRedistribution::carry(ScalarField& field) const {
  check_markers(field, "field", surface_.grid().size());
  check_finite(field, "a value");
  surface_.harmonics().analysis(field, coefficients_);
  evaluation_.values_at(coefficients_, map_, field);
}

}  // namespace vesiflow::vesicle
