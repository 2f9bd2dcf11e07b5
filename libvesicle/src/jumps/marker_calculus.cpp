// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "jumps/marker_calculus.h"

namespace vesiflow::vesicle {

MarkerCalculus::MarkerCalculus(const SphereGrid& grid) {
  for (VectorField* field :
       {&normal_, &dual_theta_, &dual_phi_, &curved_theta_, &curved_phi_, &christoffel_theta_, &christoffel_phi_})
    field->resize(grid.size(), 3);
  trace_.resize(grid.size());
  square_.resize(grid.size());
}

void MarkerCalculus::update(const Surface& surface) {
  const SurfaceGeometry& geometry = surface.geometry_with_curvature();
  normal_ = geometry.normal();
  dual_theta_ = geometry.dual_theta();
  dual_phi_ = geometry.dual_phi();
  trace_ = 2 * geometry.mean_curvature();
  square_ = trace_.square() - 2 * geometry.gaussian_curvature();
  const ConstTriples normal(normal_), a(dual_theta_), b(dual_phi_);
  const ConstTriples tt(geometry.theta_theta()), tp(geometry.theta_phi()), pp(geometry.phi_phi());
  const Triples curved_theta(curved_theta_), curved_phi(curved_phi_), theta(christoffel_theta_), phi(christoffel_phi_);
  const Eigen::Index size = trace_.size();
#pragma GCC ivdep
  for (Eigen::Index k = 0; k < size; ++k) {
    theta.set(k, {dot(a[k], tt[k]), dot(a[k], tp[k]), dot(a[k], pp[k])});
    phi.set(k, {dot(b[k], tt[k]), dot(b[k], tp[k]), dot(b[k], pp[k])});
    // S = s_ab X^a X^b, s_ab = n_a . X_b = -n . X_ab
    const double s_tt = -dot(normal[k], tt[k]), s_tp = -dot(normal[k], tp[k]), s_pp = -dot(normal[k], pp[k]);
    const double aa = dot(a[k], a[k]), ab = dot(a[k], b[k]), bb = dot(b[k], b[k]);
    curved_theta.set(k, (s_tt * aa + s_tp * ab) * a[k] + (s_tp * aa + s_pp * ab) * b[k]);
    curved_phi.set(k, (s_tt * ab + s_tp * bb) * a[k] + (s_tp * ab + s_pp * bb) * b[k]);
  }
}

MarkerCalculus::View::View(const MarkerCalculus& c)
    : normal_(c.normal_),
      dual_theta_(c.dual_theta_),
      dual_phi_(c.dual_phi_),
      curved_theta_(c.curved_theta_),
      curved_phi_(c.curved_phi_),
      theta_tt_(c.christoffel_theta_.col(0).data()),
      theta_tp_(c.christoffel_theta_.col(1).data()),
      theta_pp_(c.christoffel_theta_.col(2).data()),
      phi_tt_(c.christoffel_phi_.col(0).data()),
      phi_tp_(c.christoffel_phi_.col(1).data()),
      phi_pp_(c.christoffel_phi_.col(2).data()),
      trace_(c.trace_.data()),
      square_(c.square_.data()) {}

}  // namespace vesiflow::vesicle
