// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/surface_geometry.h"

#include <cmath>
#include <stdexcept>

#include "check.h"
#include "harmonics/check_grid.h"
#include "surface/columns.h"

namespace vesiflow::vesicle {

SurfaceGeometry::SurfaceGeometry(const SphereGrid& grid) : grid_(grid) {
  for (VectorField* field : {&theta_, &phi_, &theta_theta_, &theta_phi_, &phi_phi_, &dual_theta_, &dual_phi_, &normal_})
    field->resize(grid.size(), 3);
  for (ScalarField* field : {&area_element_, &mean_curvature_, &gaussian_curvature_}) field->resize(grid.size());
}

void SurfaceGeometry::check_arguments(const SphericalHarmonics& harmonics, const Coefficients& positions) const {
  check_grid(harmonics.grid(), "harmonics", grid_);
  check_argument(positions.fields() == 3, "fields of the positions", positions.fields(), "3");
}

void SurfaceGeometry::update(const SphericalHarmonics& harmonics, const Coefficients& positions,
                             GeometryDetail detail) {
  check_arguments(harmonics, positions);
  const bool with_curvature = detail == GeometryDetail::curvature;
  has_curvature_ = false;
  if (with_curvature)
    harmonics.derivatives(positions, theta_, phi_, theta_theta_, theta_phi_, phi_phi_);
  else
    harmonics.gradient(positions, theta_, phi_);
  update_first_form();
  check_area_elements();
  if (!with_curvature) return;
  update_second_form();
  has_curvature_ = true;
}

void SurfaceGeometry::add_curvature(const SphericalHarmonics& harmonics, const Coefficients& positions) {
  check_arguments(harmonics, positions);
  harmonics.second_derivatives(positions, theta_theta_, theta_phi_, phi_phi_);
  update_second_form();
  has_curvature_ = true;
}

void SurfaceGeometry::check_area_elements() const {
  // X_theta is of the size of the surface everywhere. An area element that is only rounding beside it has no
  // normal.
  constexpr double rounding = 1e-13;
  const double smallest = area_element_.minCoeff();
  if (!std::isfinite(area_element_.sum()) || !(smallest > rounding * theta_.square().rowwise().sum().mean()))
    throw std::domain_error("degenerate surface: the smallest area element is " + std::to_string(smallest) +
                            "; the markers have folded or collapsed");
}

void SurfaceGeometry::update_first_form() {
  const ConstColumns t(theta_), p(phi_);
  const Columns n(normal_), dt(dual_theta_), dp(dual_phi_);
  double* const area_element = area_element_.data();
  const Eigen::Index size = area_element_.size();
#pragma GCC ivdep
  for (Eigen::Index k = 0; k < size; ++k) {
    const double cx = t.y[k] * p.z[k] - t.z[k] * p.y[k];
    const double cy = t.z[k] * p.x[k] - t.x[k] * p.z[k];
    const double cz = t.x[k] * p.y[k] - t.y[k] * p.x[k];
    const double w2 = cx * cx + cy * cy + cz * cz;
    const double w = std::sqrt(w2);
    area_element[k] = w;
    n.x[k] = cx / w;
    n.y[k] = cy / w;
    n.z[k] = cz / w;
    const double e = (t.x[k] * t.x[k] + t.y[k] * t.y[k] + t.z[k] * t.z[k]) / w2;
    const double f = (t.x[k] * p.x[k] + t.y[k] * p.y[k] + t.z[k] * p.z[k]) / w2;
    const double g = (p.x[k] * p.x[k] + p.y[k] * p.y[k] + p.z[k] * p.z[k]) / w2;
    dt.x[k] = g * t.x[k] - f * p.x[k];
    dt.y[k] = g * t.y[k] - f * p.y[k];
    dt.z[k] = g * t.z[k] - f * p.z[k];
    dp.x[k] = e * p.x[k] - f * t.x[k];
    dp.y[k] = e * p.y[k] - f * t.y[k];
    dp.z[k] = e * p.z[k] - f * t.z[k];
  }
}

void SurfaceGeometry::update_second_form() {
  const ConstColumns t(theta_), p(phi_), tt(theta_theta_), tp(theta_phi_), pp(phi_phi_), n(normal_);
  const double* const area_element = area_element_.data();
  double* const mean = mean_curvature_.data();
  double* const gaussian = gaussian_curvature_.data();
  const Eigen::Index size = area_element_.size();
#pragma GCC ivdep
  for (Eigen::Index k = 0; k < size; ++k) {
    const double w2 = area_element[k] * area_element[k];
    const double e = t.x[k] * t.x[k] + t.y[k] * t.y[k] + t.z[k] * t.z[k];
    const double f = t.x[k] * p.x[k] + t.y[k] * p.y[k] + t.z[k] * p.z[k];
    const double g = p.x[k] * p.x[k] + p.y[k] * p.y[k] + p.z[k] * p.z[k];
    const double l = tt.x[k] * n.x[k] + tt.y[k] * n.y[k] + tt.z[k] * n.z[k];
    const double m = tp.x[k] * n.x[k] + tp.y[k] * n.y[k] + tp.z[k] * n.z[k];
    const double nn = pp.x[k] * n.x[k] + pp.y[k] * n.y[k] + pp.z[k] * n.z[k];
    mean[k] = (2 * f * m - g * l - e * nn) / (2 * w2);
    gaussian[k] = (l * nn - m * m) / w2;
  }
}

}  // namespace vesiflow::vesicle
