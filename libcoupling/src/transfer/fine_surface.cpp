// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/fine_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "transfer/roomy.h"
#include "transfer/shares.h"

namespace vesiflow::coupling {

namespace {

/// A sixteenth more, and then the next of 8 sizes an octave, so that a body that breathes is on few meshes, whose transforms
/// have no prime factors above 13. Even, so that there are columns at right angles to the first one: of two nodes at the
/// same distance from a point on a plane of symmetry one would be taken.
int rounded_up(int latitudes) {
  const int more = latitudes + latitudes / 16;
  const int step = std::max(2, static_cast<int>(std::bit_floor(static_cast<unsigned>(more))) / 8);
  return (more + step - 1) / step * step;
}

}  // namespace

void FineSurface::choose_mesh(int latitudes, int degrees) {
  auto found = std::ranges::find_if(meshes_, [&](const auto& one) {
    return one->mesh.latitudes() == latitudes && one->harmonics.degrees() == degrees;
  });
  if (found == meshes_.end()) found = meshes_.insert(found, std::make_unique<OnMesh>(latitudes, degrees));
  if (on_mesh_ == found->get()) return;
  on_mesh_ = found->get();
  const auto size = static_cast<std::size_t>(mesh().table_size());
  resize_with_room(surface_, size);
  resize_with_room(jumps_, size * static_cast<std::size_t>(own_records_));
  std::ranges::fill(surface_, SurfacePoint{decltype(SurfacePoint::position_and_normal)::Zero(),
                                           decltype(SurfacePoint::slopes)::Zero()});
  std::ranges::fill(jumps_, Four::Zero());
}

void FineSurface::update(const vesicle::Surface& surface, double spacing) {
  spacing_ = spacing;
  const double longest = std::sqrt(std::max(surface.tangent_theta().square().rowwise().sum().maxCoeff(),
                                            surface.tangent_phi().square().rowwise().sum().maxCoeff()));
  const int latitudes =
      std::max(ParameterMesh::fewest_latitudes, static_cast<int>(std::ceil(std::numbers::pi * longest / spacing)));
  const vesicle::Coefficients& x = surface.position_coefficients();
  choose_mesh(rounded_up(latitudes), x.degrees());

  on_mesh_->geometry.update(on_mesh_->harmonics, x, vesicle::GeometryDetail::curvature);
  values_.resize(nodes(), 3);
  on_mesh_->harmonics.synthesis(x, values_);
  lower_ = values_.colwise().minCoeff().transpose();
  upper_ = values_.colwise().maxCoeff().transpose();
  tabulate_surface();
  find_sparse_nodes();
}

void FineSurface::tabulate_surface() {
  const vesicle::SurfaceGeometry& g = on_mesh_->geometry;
  const auto tabulate = [&](int i, int j) {
    const Eigen::Index node = mesh().grid().index(i, j);
    const auto row = [node](const auto& field) { return Eigen::Vector3d(field.row(node).transpose()); };
    const Eigen::Vector3d n = row(g.normal());
    SurfacePoint& point = surface_[static_cast<std::size_t>(mesh().in_table(j, i))];
    point.position_and_normal.segment<3>(0) = row(values_).array();
    point.position_and_normal.segment<3>(4) = n.array();

    const Eigen::Vector3f dual_theta = row(g.dual_theta()).cast<float>(), dual_phi = row(g.dual_phi()).cast<float>();
    const auto [s_theta, s_phi] = mesh().tangents_at({j, i});
    Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>{point.slopes.data()} =
        s_theta.cast<float>() * dual_theta.transpose() + s_phi.cast<float>() * dual_phi.transpose();
    // S = -(n . X_ab) X^a X^b.
    const auto tt = static_cast<float>(-n.dot(row(g.theta_theta())));
    const auto tp = static_cast<float>(-n.dot(row(g.theta_phi())));
    const auto pp = static_cast<float>(-n.dot(row(g.phi_phi())));
    const Eigen::Vector3f a = tt * dual_theta + tp * dual_phi, b = tp * dual_theta + pp * dual_phi;
    const auto shape = [&](int k, int l) { return a[k] * dual_theta[l] + b[k] * dual_phi[l]; };
    for (int k = 0; k < 3; ++k) {
      point.slopes[9 + k] = shape(k, k);
      point.slopes[12 + k] = shape(k, (k + 1) % 3);
    }
  };
  in_shares(latitudes(), [&](Eigen::Index begin, Eigen::Index end) {
    for (auto j = static_cast<int>(begin); j < static_cast<int>(end); ++j)
      for (int i = 0; i < longitudes(); ++i) tabulate(i, j);
  });
  mesh().fill_margins(surface_.data());
}

void FineSurface::find_sparse_nodes() {
  reserve_with_room(sparse_nodes_, static_cast<std::size_t>(nodes()));
  sparse_nodes_.clear();
  const int half = longitudes() / 2;
  for (int j = 0; j < latitudes(); ++j) {
    const auto tangents = on_mesh_->geometry.tangent_phi().middleRows(mesh().grid().index(0, j), longitudes());
    const double apart = std::sqrt(tangents.square().rowwise().sum().maxCoeff()) * mesh().grid().longitude_spacing();
    const int stride = std::max(1, static_cast<int>(spacing_ / apart));
    for (int i = 0; i < longitudes(); ++i) {
      // Both ways from column 0 and from the one on the other side, to the middle between them.
      const int from = std::min(i % half, half - i % half);
      if (from % stride == 0 || from == half / 2) sparse_nodes_.push_back({j, i});
    }
  }
}

void FineSurface::set(const vesicle::Coefficients& fields, const std::vector<int>& slots) {
  if (fields_.rows() != nodes() || fields_.cols() < fields.fields()) fields_.resize(nodes(), fields.fields());
  padded_.resample(fields, on_mesh_->harmonics.degrees());
  on_mesh_->harmonics.synthesis(padded_, fields_.leftCols(fields.fields()));
  std::ranges::fill(jumps_, Four::Zero());  // also the numbers that this call does not name
  for (int f = 0; f < fields.fields(); ++f) {
    const int slot = slots[static_cast<std::size_t>(f)];
    Four* record = jumps_.data() + mesh().table_size() * (slot / 4);
    for (int j = 0; j < latitudes(); ++j) {
      Four* to = record + mesh().in_table(j, 0);
      const double* from = &fields_(mesh().grid().index(0, j), f);
      for (int i = 0; i < longitudes(); ++i) to[i][slot % 4] = from[i];
    }
  }
  for (int record = 0; record < own_records_; ++record)
    mesh().fill_margins(jumps_.data() + mesh().table_size() * record);
}

FineSurface::Four FineSurface::at_node(int column, int row, int record) const {
  const auto node = static_cast<std::size_t>(mesh().in_table(row, column));
  if (record == position) return surface_[node].position();
  return record == normal ? Four(surface_[node].normal()) : table_of(record)[node];
}

SurfacePoint FineSurface::at(const Place& place) const {
  using Both = decltype(SurfacePoint::position_and_normal);
  using Slopes = decltype(SurfacePoint::slopes);
  constexpr int width = ParameterMesh::width;
  const ParameterMesh::Weights weights = mesh().weights(place);
  const SurfacePoint* const first = surface_.data() + mesh().first_in_table(place);
  SurfacePoint sum{Both::Zero(), Slopes::Zero()};
  // Twice over the nodes, so that the weights of the columns stay in registers.
  const SurfacePoint* node = first;
  for (int j = 0; j < width; ++j, node += mesh().row_size()) {
    Both row = Both::Zero();
    for (int i = 0; i < width; ++i) row += weights.of_column[i] * node[i].position_and_normal;
    sum.position_and_normal += weights.of_row[j] * row;
  }
  Eigen::Array<float, 8, 1> of_row, of_column;
#pragma omp simd
  for (int i = 0; i < 8; ++i) {
    of_row[i] = static_cast<float>(weights.of_row[i]);
    of_column[i] = static_cast<float>(weights.of_column[i]);
  }
  node = first;
  for (int j = 0; j < width; ++j, node += mesh().row_size()) {
    Slopes slopes = Slopes::Zero();
    for (int i = 0; i < width; ++i) slopes += of_column[i] * node[i].slopes;
    sum.slopes += of_row[j] * slopes;
  }
  return sum;
}

}  // namespace vesiflow::coupling
