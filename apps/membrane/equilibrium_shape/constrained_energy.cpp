// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "constrained_energy.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace equilibrium {
namespace {

using std::numbers::pi;
using vesiflow::vesicle::BendingForce;
using vesiflow::vesicle::ScalarField;
using vesiflow::vesicle::SphereGrid;

/// The library's bending force at capillary number one, which is minus the derivative of (1/2) int H^2 dA.
BendingForce bending_force(const SphereGrid& grid) {
  return BendingForce(grid, {.capillary_number = 1, .spontaneous_curvature = 0, .laplacian = {}});
}

/// Modes of the tangent angle: sin(2 k theta) up to degree 3N/4, which leaves the mesh room for the products in the curvatures.
int modes_of(int latitudes) {
  if (latitudes < ConstrainedEnergy::minimum_latitudes)
    throw std::invalid_argument(
        fmt::format("latitudes = {}: must be >= {}", latitudes, ConstrainedEnergy::minimum_latitudes));
  return 3 * latitudes / 8;
}

}  // namespace

ConstrainedEnergy::ConstrainedEnergy(int latitudes)
    : surface_(latitudes),
      bending_(bending_force(surface_.grid())),
      meridian_(surface_.grid(), modes_of(latitudes)),
      target_area_(4 * pi),
      target_volume_(4 * pi / 3),
      positions_(surface_.grid().size(), 3),
      force_(surface_.grid().size(), 3) {}

void ConstrainedEnergy::set_reduced_volume(double reduced_volume) {
  if (!(reduced_volume > 0 && reduced_volume <= 1))
    throw std::invalid_argument(fmt::format("reduced_volume = {}: must be in (0, 1]", reduced_volume));
  target_area_ = 4 * pi * std::pow(reduced_volume, -2.0 / 3);
}

void ConstrainedEnergy::set(const Eigen::VectorXd& x) {
  meridian_.set(x);
  const SphereGrid& grid = surface_.grid();
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const Eigen::Index marker = grid.index(i, j);
      positions_(marker, 0) = meridian_.rho()[j] * std::cos(grid.longitude(i));
      positions_(marker, 1) = meridian_.rho()[j] * std::sin(grid.longitude(i));
      positions_(marker, 2) = meridian_.z()[j];
    }
  surface_.update(positions_, vesiflow::vesicle::GeometryDetail::curvature);
  functionals_ = {vesiflow::vesicle::bending_energy(surface_), surface_.area(), surface_.volume()};
}

Eigen::Vector2d ConstrainedEnergy::constraint_errors() const {
  return {functionals_.area / target_area_ - 1, functionals_.volume / target_volume_ - 1};
}

/// int density n . dX dA. The markers of a ring agree, and the first of them lies in the plane y = 0.
Eigen::VectorXd ConstrainedEnergy::first_variation(const ScalarField& density) const {
  const SphereGrid& grid = surface_.grid();
  Eigen::ArrayXd along_rho(grid.latitudes()), along_z(grid.latitudes());
  for (int j = 0; j < grid.latitudes(); ++j) {
    const Eigen::Index marker = grid.index(0, j);
    const double ring = density[marker] * surface_.area_weight()[marker] * grid.longitudes();
    along_rho[j] = ring * surface_.normal()(marker, 0);
    along_z[j] = ring * surface_.normal()(marker, 2);
  }
  return rho_derivative_.matrix().transpose() * along_rho.matrix() +
         z_derivative_.matrix().transpose() * along_z.matrix();
}

const Gradients& ConstrainedEnergy::constraint_gradients() {
  meridian_.differentiate(rho_derivative_, z_derivative_);
  gradients_.area = first_variation(2 * surface_.mean_curvature());
  gradients_.volume = first_variation(ScalarField::Ones(surface_.grid().size()));
  return gradients_;
}

const Gradients& ConstrainedEnergy::gradients() {
  constraint_gradients();
  force_.setZero();
  bending_.add_to(surface_, force_);
  normal_force_ = (force_ * surface_.normal()).rowwise().sum();
  gradients_.energy = -first_variation(normal_force_);
  ++gradient_evaluations_;
  return gradients_;
}

}  // namespace equilibrium
