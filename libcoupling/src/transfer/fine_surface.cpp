// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/fine_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transfer/shares.h"

namespace vesiflow::coupling {

void FineSurface::make_mesh(int latitudes, int degrees) {
  degrees_ = degrees;
  mesh_.emplace(latitudes);
  harmonics_.emplace(degrees, mesh_->grid(), 3);
  geometry_.emplace(mesh_->grid());
  stride_of_row_.resize(static_cast<std::size_t>(latitudes));
  const auto size = static_cast<std::size_t>(mesh_->table_size());
  form_.assign(form_size * size, 0.0);
  slopes_.assign(slopes_size * size, 0.0F);
  jumps_.assign(4 * size * static_cast<std::size_t>(own_records_), 0.0);
}

void FineSurface::update(const vesicle::Surface& surface, double spacing) {
  const double longest = std::sqrt(std::max(surface.tangent_theta().square().rowwise().sum().maxCoeff(),
                                            surface.tangent_phi().square().rowwise().sum().maxCoeff()));
  const int wanted =
      std::max(ParameterMesh::fewest_latitudes, static_cast<int>(std::ceil(std::numbers::pi * longest / spacing)));
  const vesicle::Coefficients& x = surface.position_coefficients();
  // With room to grow, so that a body that stretches does not make a new mesh in every step.
  if (!mesh_ || latitudes() < wanted || degrees_ != x.degrees()) make_mesh(wanted + wanted / 16, x.degrees());
  spacing_ = spacing;

  geometry_->update(*harmonics_, x, vesicle::GeometryDetail::curvature);
  values_.resize(nodes(), 3);
  harmonics_->synthesis(x, values_);
  lower_ = values_.colwise().minCoeff().transpose();
  upper_ = values_.colwise().maxCoeff().transpose();
  tabulate_surface();
  find_strides();
}

void FineSurface::tabulate_surface() {
  const vesicle::SurfaceGeometry& g = *geometry_;
  const auto tabulate = [&](int i, int j) {
    const Eigen::Index node = mesh_->grid().index(i, j);
    const std::ptrdiff_t place = mesh_->in_table(j, i);
    const auto row = [node](const auto& field) { return Eigen::Vector3d(field.row(node).transpose()); };
    const Eigen::Vector3d n = row(g.normal());
    Eigen::Map<Eigen::Vector3d>{form_.data() + form_size* place} = row(values_);
    Eigen::Map<Eigen::Vector3d>{form_.data() + form_size* place + 4} = n;

    const Eigen::Vector3f dual_theta = row(g.dual_theta()).cast<float>(), dual_phi = row(g.dual_phi()).cast<float>();
    const auto [s_theta, s_phi] = mesh_->tangents_at({j, i});
    float* slopes = slopes_.data() + slopes_size * place;
    Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{slopes} =
        s_theta.cast<float>() * dual_theta.transpose() + s_phi.cast<float>() * dual_phi.transpose();
    // S = -(n . X_ab) X^a X^b.
    const auto tt = static_cast<float>(-n.dot(row(g.theta_theta())));
    const auto tp = static_cast<float>(-n.dot(row(g.theta_phi())));
    const auto pp = static_cast<float>(-n.dot(row(g.phi_phi())));
    const Eigen::Vector3f a = tt * dual_theta + tp * dual_phi, b = tp * dual_theta + pp * dual_phi;
    const auto shape = [&](int k, int l) { return a[k] * dual_theta[l] + b[k] * dual_phi[l]; };
    for (int k = 0; k < 3; ++k) {
      slopes[9 + k] = shape(k, k);
      slopes[12 + k] = shape(k, (k + 1) % 3);
    }
  };
  in_shares(latitudes(), [&](Eigen::Index begin, Eigen::Index end) {
    for (auto j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < longitudes(); ++i) tabulate(i, j);
  });
  mesh_->fill_margins(form_.data(), form_size);
  mesh_->fill_margins(slopes_.data(), slopes_size);
}

void FineSurface::find_strides() {
  for (int j = 0; j < latitudes(); ++j) {
    const auto tangents = geometry_->tangent_phi().middleRows(mesh_->grid().index(0, j), longitudes());
    const double apart = std::sqrt(tangents.square().rowwise().sum().maxCoeff()) * mesh_->grid().longitude_spacing();
    stride_of_row_[static_cast<std::size_t>(j)] = std::max(1, static_cast<int>(spacing_ / apart));
  }
}

void FineSurface::set(const vesicle::Coefficients& fields, const std::vector<int>& slots) {
  if (fields_.rows() != nodes() || fields_.cols() < fields.fields()) fields_.resize(nodes(), fields.fields());
  padded_.resample(fields, degrees_);
  harmonics_->synthesis(padded_, fields_.leftCols(fields.fields()));
  std::ranges::fill(jumps_, 0.0);  // also the numbers that this call does not name
  for (int f = 0; f < fields.fields(); ++f) {
    const int slot = slots[static_cast<std::size_t>(f)];
    double* record = jumps_.data() + 4 * mesh_->table_size() * (slot / 4) + slot % 4;
    for (int j = 0; j < latitudes(); ++j) {
      double* to = record + 4 * mesh_->in_table(j, 0);
      const double* from = &fields_(mesh_->grid().index(0, j), f);
      for (int i = 0; i < longitudes(); ++i) to[4 * i] = from[i];
    }
  }
  for (int record = 0; record < own_records_; ++record)
    mesh_->fill_margins(jumps_.data() + 4 * mesh_->table_size() * record, 4);
}

}  // namespace vesiflow::coupling
