// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "meridian.h"

#include <cmath>
#include <numbers>

namespace equilibrium {
namespace {

using std::numbers::pi;
using vesiflow::vesicle::SphereGrid;

// Nodes per interval: the integrand turns by less than 3 pi / 4 in it, and ten nodes then err by rounding only.
constexpr int rule_nodes = 10;

}  // namespace

Meridian::Meridian(const SphereGrid& grid, int modes)
    : latitudes_(grid.latitudes()),
      northern_((grid.latitudes() + 1) / 2),
      angle_(rule_nodes * (northern_ + 1)),
      weight_(angle_.size()),
      sine_(angle_.size(), modes),
      b_(Eigen::ArrayXd::Zero(modes)),
      rho_(latitudes_),
      z_(latitudes_) {
  const SphereGrid rule(rule_nodes);  // its cosines and weights are those of Gauss-Legendre quadrature
  double start = 0;
  for (int interval = 0; interval <= northern_; ++interval) {
    const double end = interval < northern_ ? grid.colatitude()[interval] : pi / 2;
    angle_.segment(rule_nodes * interval, rule_nodes) = start + (end - start) / 2 * (1 - rule.cos_colatitude());
    weight_.segment(rule_nodes * interval, rule_nodes) = (end - start) / 2 * rule.weight();
    start = end;
  }
  for (int k = 1; k <= modes; ++k) sine_.col(k - 1) = (2 * k * angle_).sin();
  set(Eigen::VectorXd::Unit(unknowns(), 0));
}

void Meridian::set(const Eigen::VectorXd& x) {
  ell_ = x[0];
  for (int k = 1; k <= modes(); ++k) b_[k - 1] = x[k] / (2 * k);
  const Eigen::ArrayXd phi = angle_ + (sine_.matrix() * b_.matrix()).array();
  weighted_cosine_ = ell_ * weight_ * phi.cos();
  weighted_sine_ = ell_ * weight_ * phi.sin();

  double rho = 0;
  for (int j = 0; j < northern_; ++j) {
    rho += weighted_cosine_.segment(rule_nodes * j, rule_nodes).sum();
    rho_[j] = rho_[latitudes_ - 1 - j] = rho;
  }
  equatorial_radius_ = rho + weighted_cosine_.tail(rule_nodes).sum();
  double z = 0;
  for (int j = northern_ - 1; j >= 0; --j) {
    z += weighted_sine_.segment(rule_nodes * (j + 1), rule_nodes).sum();
    z_[latitudes_ - 1 - j] = -z;
    z_[j] = z;
  }
  polar_semi_axis_ = z + weighted_sine_.head(rule_nodes).sum();
}

void Meridian::differentiate(Eigen::ArrayXXd& rho, Eigen::ArrayXXd& z) const {
  rho.resize(latitudes_, unknowns());
  z.resize(latitudes_, unknowns());
  rho.col(0) = rho_ / ell_;
  z.col(0) = z_ / ell_;
  for (int k = 1; k <= modes(); ++k) {
    // d phi / d x_k = sin(2 k theta) / (2 k) turns the tangent.
    const Eigen::ArrayXd turn = sine_.col(k - 1) / (2 * k);
    double sum = 0;
    for (int j = 0; j < northern_; ++j) {
      const int nodes = rule_nodes * j;
      sum -= (weighted_sine_.segment(nodes, rule_nodes) * turn.segment(nodes, rule_nodes)).sum();
      rho(j, k) = rho(latitudes_ - 1 - j, k) = sum;
    }
    sum = 0;
    for (int j = northern_ - 1; j >= 0; --j) {
      const int nodes = rule_nodes * (j + 1);
      sum += (weighted_cosine_.segment(nodes, rule_nodes) * turn.segment(nodes, rule_nodes)).sum();
      z(latitudes_ - 1 - j, k) = -sum;
      z(j, k) = sum;
    }
  }
}

double Meridian::tangent_angle(double theta) const {
  double phi = theta;
  for (int k = 1; k <= modes(); ++k) phi += b_[k - 1] * std::sin(2 * k * theta);
  return phi;
}

double Meridian::tangent_angle_slope(double theta) const {
  double slope = 1;
  for (int k = 1; k <= modes(); ++k) slope += 2 * k * b_[k - 1] * std::cos(2 * k * theta);
  return slope;
}

double Meridian::polar_mean_curvature() const {
  return tangent_angle_slope(0) / ell_;
}

double Meridian::equatorial_mean_curvature() const {
  return (tangent_angle_slope(pi / 2) / ell_ + 1 / equatorial_radius_) / 2;
}

double Meridian::last_coefficient() const {
  return b_.tail(std::min(2, modes())).abs().maxCoeff();
}

}  // namespace equilibrium
