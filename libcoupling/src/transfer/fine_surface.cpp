// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/fine_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesiflow::coupling {
namespace {

constexpr int points = 6;
/// Six rows on either side of a pole are different rows.
constexpr int fewest_latitudes = 8;

/// Lagrange's products prod_{j != i} (x - x_j), i = 0 .. 5.
std::array<double, points> numerators(const std::array<double, points>& distance) {
  std::array<double, points> result;
  double before = 1.0;
  for (int i = 0; i < points; ++i) {
    result[i] = before;
    before *= distance[i];
  }
  double after = 1.0;
  for (int i = points - 1; i >= 0; --i) {
    result[i] *= after;
    after *= distance[i];
  }
  return result;
}

}  // namespace

void FineSurface::make_mesh(int latitudes, int degrees) {
  degrees_ = degrees;
  grid_.emplace(latitudes);
  harmonics_.emplace(degrees, *grid_, 3);
  geometry_.emplace(*grid_);
  columns_ = grid_->longitudes() + 2 * margin;
  plane_ = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(latitudes + 2 * margin);
  table_.assign(4 * plane_ * static_cast<std::size_t>(records()), 0.0);

  colatitude_.resize(static_cast<std::size_t>(latitudes + 2 * margin));
  const auto& theta = grid_->colatitude();
  for (int j = -margin; j < latitudes + margin; ++j) {
    double& value = colatitude_[static_cast<std::size_t>(j + margin)];
    if (j < 0)
      value = -theta[-1 - j];
    else if (j < latitudes)
      value = theta[j];
    else
      value = 2.0 * std::numbers::pi - theta[2 * latitudes - 1 - j];
  }
  inverse_.resize(colatitude_.size() - points + 1);
  for (std::size_t first = 0; first < inverse_.size(); ++first)
    for (std::size_t i = 0; i < points; ++i) {
      double product = 1.0;
      for (std::size_t j = 0; j < points; ++j)
        if (j != i) product *= colatitude_[first + i] - colatitude_[first + j];
      inverse_[first][i] = 1.0 / product;
    }
}

void FineSurface::update(const vesicle::Surface& surface, double spacing) {
  const double longest = std::sqrt(std::max(surface.tangent_theta().square().rowwise().sum().maxCoeff(),
                                            surface.tangent_phi().square().rowwise().sum().maxCoeff()));
  const int wanted = std::max(fewest_latitudes, static_cast<int>(std::ceil(std::numbers::pi * longest / spacing)));
  const int degrees = surface.position_coefficients().degrees();
  // With room to grow, so that a body that stretches does not make a new mesh in every step.
  if (!grid_ || grid_->latitudes() < wanted || degrees_ != degrees) make_mesh(wanted + wanted / 16, degrees);

  const vesicle::Coefficients& x = surface.position_coefficients();
  geometry_->update(*harmonics_, x, vesicle::GeometryDetail::curvature);
  values_.resize(grid_->size(), 3);
  harmonics_->synthesis(x, values_);
  const vesicle::SurfaceGeometry& g = *geometry_;
  for (int j = 0; j < latitudes(); ++j)
    for (int i = 0; i < longitudes(); ++i) {
      const Eigen::Index node = grid_->index(i, j);
      const auto row = [node](const vesicle::VectorField& field) {
        return Eigen::Vector3d(field.row(node).transpose());
      };
      const Eigen::Vector3d n = row(g.normal()), dual_theta = row(g.dual_theta()), dual_phi = row(g.dual_phi());
      const double sin_theta = grid_->sin_colatitude()[j], cos_theta = grid_->cos_colatitude()[j],
                   phi = grid_->longitude(i);
      const Eigen::Vector3d s_theta(cos_theta * std::cos(phi), cos_theta * std::sin(phi), -sin_theta);
      const Eigen::Vector3d s_phi(-sin_theta * std::sin(phi), sin_theta * std::cos(phi), 0.0);
      const Eigen::Matrix3d rows = s_theta * dual_theta.transpose() + s_phi * dual_phi.transpose();
      const Eigen::Matrix3d mixed = dual_theta * dual_phi.transpose();
      const Eigen::Matrix3d s = -(n.dot(row(g.theta_theta())) * dual_theta * dual_theta.transpose() +
                                  n.dot(row(g.theta_phi())) * (mixed + mixed.transpose()) +
                                  n.dot(row(g.phi_phi())) * dual_phi * dual_phi.transpose());
      const auto put = [&](int record, double a, double b, double c) {
        double* to = entry(j, i, record);
        to[0] = a, to[1] = b, to[2] = c, to[3] = 0.0;
      };
      put(position, values_(node, 0), values_(node, 1), values_(node, 2));
      put(normal, n[0], n[1], n[2]);
      for (int k = 0; k < 3; ++k) put(direction + k, rows(k, 0), rows(k, 1), rows(k, 2));
      put(shape, s(0, 0), s(1, 1), s(2, 2));
      put(shape_mixed, s(0, 1), s(1, 2), s(2, 0));
    }
  continue_across_edges(0, jumps);
}

void FineSurface::set(const vesicle::Coefficients& fields, const std::vector<int>& slots) {
  values_.resize(grid_->size(), fields.fields());
  padded_.resample(fields, degrees_);
  harmonics_->synthesis(padded_, values_);
  for (int j = 0; j < latitudes(); ++j)
    for (int f = 0; f < fields.fields(); ++f) {
      double* to = entry(j, 0, jumps + slots[static_cast<std::size_t>(f)] / 4) + slots[static_cast<std::size_t>(f)] % 4;
      const double* from = &values_(grid_->index(0, j), f);
      for (int i = 0; i < longitudes(); ++i) to[4 * i] = from[i];
    }
  continue_across_edges(jumps, records());
}

void FineSurface::continue_across_edges(int first_record, int last_record) {
  const int n = latitudes(), m = longitudes();
  for (int record = first_record; record < last_record; ++record) {
    const auto copy = [&](int row, int column, int from_row, int from_column) {
      std::copy_n(entry(from_row, from_column, record), 4, entry(row, column, record));
    };
    for (int j = -margin; j < n + margin; ++j) {
      // Across a pole lies the meridian on the other side.
      const int from = j < 0 ? -1 - j : j >= n ? 2 * n - 1 - j : j;
      if (from != j)
        for (int i = 0; i < m; ++i) copy(j, i, from, (i + m / 2) % m);
      for (int i = 1; i <= margin; ++i) {
        copy(j, -i, j, m - i);
        copy(j, m + i - 1, j, i - 1);
      }
    }
  }
}

FineSurface::Direction FineSurface::direction_of_node(int i, int j) const {
  const double s = grid_->sin_colatitude()[j], phi = grid_->longitude(i);
  return {s * std::cos(phi), s * std::sin(phi), grid_->cos_colatitude()[j]};
}

FineSurface::Place FineSurface::place_of(const Direction& s) const {
  Place place;
  const double theta = std::atan2(std::hypot(s[0], s[1]), s[2]);
  double phi = std::atan2(s[1], s[0]);
  if (phi < 0.0) phi += 2.0 * std::numbers::pi;

  // Gauss colatitudes are (j + 3/4) pi / (N + 1/2) but for a small part of their distance.
  int row = static_cast<int>(theta * (latitudes() + 0.5) / std::numbers::pi - 0.75 + 1.0) - 1;
  const auto colatitude = [this](int j) { return colatitude_[static_cast<std::size_t>(j + margin)]; };
  while (row > -1 && colatitude(row) > theta) --row;
  while (row < latitudes() - 1 && colatitude(row + 1) <= theta) ++row;
  const int first_row = row - 2;
  std::array<double, points> distance;
  for (int i = 0; i < points; ++i) distance[i] = theta - colatitude(first_row + i);
  place.theta = numerators(distance);
  const auto& inverse = inverse_[static_cast<std::size_t>(first_row + margin)];
  for (int i = 0; i < points; ++i) place.theta[i] *= inverse[i];

  const double at = phi / grid_->longitude_spacing();
  const int column = std::min(static_cast<int>(at), longitudes() - 1);
  for (int i = 0; i < points; ++i) distance[i] = at - column - (i - 2);
  place.phi = numerators(distance);
  constexpr std::array<double, points> denominators = {-120.0, 24.0, -12.0, 12.0, -24.0, 120.0};
  for (int i = 0; i < points; ++i) place.phi[i] /= denominators[i];
  place.first = static_cast<std::ptrdiff_t>(offset(first_row, column - 2, 0));
  return place;
}

FineSurface::Four FineSurface::value(const Place& place, int record) const {
  const double* at = table_.data() + place.first + static_cast<std::ptrdiff_t>(4 * plane_) * record;
  Four result = Four::Zero();
  for (int j = 0; j < points; ++j) {
    Four row = Four::Zero();
    for (int i = 0; i < points; ++i) row += place.phi[i] * Eigen::Map<const Four>(at + 4 * i);
    result += place.theta[j] * row;
    at += 4 * columns_;
  }
  return result;
}

}  // namespace vesiflow::coupling
