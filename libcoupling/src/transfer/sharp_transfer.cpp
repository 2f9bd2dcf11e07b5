// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/sharp_transfer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vesiflow::coupling {
namespace {

/// Nodes of the mesh that jumps are looked up on, in spacings of the grid.
constexpr double node_distance = 0.9;
/// The corner of a stencil of 4 x 4 x 4 points, in spacings.
const double reading_width = 2.0 * std::sqrt(3.0) + 0.01;
constexpr int pressure_band = 3;

/// Records of FineSurface: [u_i], [u_i]_n, [u_i]_nn, [u_i]_nnn of the components, and those of p.
std::vector<int> slots(bool velocity_jump) {
  using vesicle::JumpColumns;
  std::vector<int> slot(
      static_cast<std::size_t>(velocity_jump ? JumpColumns::with_velocity_jump : JumpColumns::without_velocity_jump));
  slot[JumpColumns::pressure] = 4 * pressure_band;
  slot[JumpColumns::pressure_normal] = 4 * pressure_band + 1;
  slot[JumpColumns::pressure_second_normal] = 4 * pressure_band + 2;
  for (int i = 0; i < 3; ++i) {
    const auto at = [i](int column) { return static_cast<std::size_t>(column + i); };
    slot[at(JumpColumns::velocity_normal)] = 4 * i + 1;
    slot[at(JumpColumns::velocity_second_normal)] = 4 * i + 2;
    slot[at(JumpColumns::velocity_third_normal)] = 4 * i + 3;
    if (velocity_jump) slot[at(JumpColumns::velocity)] = 4 * i;
  }
  return slot;
}

/// Of Lagrange's polynomials for the nodes -1, 0, 1, 2, at 0 <= x < 1.
std::array<double, 4> lagrange(double x) {
  return {-x * (x - 1.0) * (x - 2.0) / 6.0, (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0, -(x + 1.0) * x * (x - 2.0) / 2.0,
          (x + 1.0) * x * (x - 1.0) / 6.0};
}

}  // namespace

SharpTransfer::SharpTransfer(const fluid::Grid& grid, const vesicle::SphereGrid& markers, const Parameters& parameters)
    : grid_(grid),
      parameters_(parameters),
      smoothing_(parameters.smoothing * grid.min_spacing()),
      jumps_(markers, {.degrees = parameters.degrees, .jump_degrees = markers.latitudes(), .cut = {}}),
      fine_(4) {
  for (const fluid::Centring centring : fluid::face_centrings) bands_.emplace_back(grid, centring);
  bands_.emplace_back(grid, fluid::Centring::cell);
}

void SharpTransfer::update(const vesicle::Surface& surface) {
  double h = 0.0;
  for (int axis = 0; axis < 3; ++axis) h = std::max(h, grid_.spacing(axis));
  jumps_.update(surface);
  fine_.update(surface, node_distance * grid_.min_spacing());
#pragma omp parallel for schedule(dynamic, 1)
  for (int c = 0; c < 4; ++c) {
    const double width = c == pressure_band ? smoothing_ + h + 0.01 * h : reading_width * h;
    bands_[static_cast<std::size_t>(c)].update(fine_, width);
  }
  positions_ = surface.positions();
  area_weight_ = surface.area_weight();
}

void SharpTransfer::set_force(const vesicle::VectorField& force, const vesicle::VectorField* velocity_jump) {
  if (velocity_jump != nullptr)
    jumps_.compute(force, *velocity_jump);
  else
    jumps_.compute(force);
  fine_.set(jumps_.coefficients(), slots(velocity_jump != nullptr));
#pragma omp parallel for schedule(dynamic, 1)
  for (int c = 0; c < 4; ++c) bands_[static_cast<std::size_t>(c)].evaluate(fine_, FineSurface::jumps + c);
  force_ = force;
}

// 1 inside, 0 outside.
double SharpTransfer::blend(double d) const {
  const double x = std::clamp(0.5 * (1.0 - d / smoothing_), 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}

int SharpTransfer::wrapped(int index, int axis) const {
  if (!grid_.periodic[static_cast<std::size_t>(axis)]) return index;
  const int cells = grid_.cells[static_cast<std::size_t>(axis)];
  return ((index % cells) + cells) % cells;
}

// M(chi D) - theta M(D) at a point: every arm of the stencil takes (chi - theta) D at its end.
double SharpTransfer::momentum_at(int component, int i, int j, int k, std::ptrdiff_t at, double theta) const {
  const GridBand& u = bands_[static_cast<std::size_t>(component)];
  const GridBand& p = bands_[pressure_band];
  const auto part = [theta](const GridBand& band, std::ptrdiff_t place) {
    return ((band.is_inside(place) ? 1.0 : 0.0) - theta) * band.jump(place);
  };
  const double here = part(u, at);
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = grid_.spacing(axis);
    sum += (part(u, at + u.stride(axis)) + part(u, at - u.stride(axis)) - 2.0 * here) / (h * h);
  }
  // A face lies between the cell below it, of the index before, and the one of its own.
  const std::ptrdiff_t above = p.offset(i, j, k);
  return sum - (part(p, above) - part(p, above - p.stride(component))) / grid_.spacing(component);
}

void SharpTransfer::add_component(int component, fluid::View density, Moments& moments) const {
  const GridBand& band = bands_[static_cast<std::size_t>(component)];
  const double volume = grid_.cell_volume();
  const double h = grid_.min_spacing();
  const double reach =
      std::max(smoothing_, std::max({grid_.spacing(0), grid_.spacing(1), grid_.spacing(2)})) + 1e-9 * h;
  const auto& first = band.first();
  const auto& n = band.extent();
  for (int c = 0; c < n[2]; ++c)
    for (int b = 0; b < n[1]; ++b)
      for (int a = 0; a < n[0]; ++a) {
        const int i = first[0] + a, j = first[1] + b, k = first[2] + c;
        const std::ptrdiff_t at = band.offset(i, j, k);
        const double d = band.distance(at);
        if (!(std::abs(d) <= reach)) continue;
        const double f = momentum_at(component, i, j, k, at, blend(d));
        density(wrapped(i, 0), wrapped(j, 1), wrapped(k, 2)) += f;
        const fluid::Vector3 x =
            fluid::point_position(grid_, fluid::face_centrings[static_cast<std::size_t>(component)], i, j, k);
        Eigen::Vector3d force = Eigen::Vector3d::Zero();
        force[component] = f * volume;
        moments.force += force;
        moments.torque += Eigen::Vector3d(x[0], x[1], x[2]).cross(force);
      }
}

void SharpTransfer::add_source(fluid::View source) const {
  const GridBand& p = bands_[pressure_band];
  const double reach =
      std::max(smoothing_, 0.5 * std::max({grid_.spacing(0), grid_.spacing(1), grid_.spacing(2)})) * (1.0 + 1e-9);
  const auto& first = p.first();
  const auto& n = p.extent();
  for (int c = 0; c < n[2]; ++c)
    for (int b = 0; b < n[1]; ++b)
      for (int a = 0; a < n[0]; ++a) {
        const int i = first[0] + a, j = first[1] + b, k = first[2] + c;
        const double d = p.distance(p.offset(i, j, k));
        if (!(std::abs(d) <= reach)) continue;
        const double theta = blend(d);
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
          const GridBand& u = bands_[static_cast<std::size_t>(axis)];
          const auto part = [&](std::ptrdiff_t place) {
            return ((u.is_inside(place) ? 1.0 : 0.0) - theta) * u.jump(place);
          };
          const std::ptrdiff_t below = u.offset(i, j, k);
          sum -= (part(below + u.stride(axis)) - part(below)) / grid_.spacing(axis);
        }
        source(wrapped(i, 0), wrapped(j, 1), wrapped(k, 2)) += sum;
      }
}

void SharpTransfer::add_to(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source, MarkerTransfer& delta) {
  std::array<Moments, 3> moments;
  const auto views = density.points();
#pragma omp parallel for schedule(dynamic, 1)
  for (int c = 0; c < 4; ++c)
    if (c == pressure_band)
      add_source(source.points());
    else
      add_component(c, views[static_cast<std::size_t>(c)], moments[static_cast<std::size_t>(c)]);
  for (std::size_t c = 0; c < 4; ++c) touched_[c].push_back({bands_[c].first(), bands_[c].extent()});
  Moments put;
  for (const Moments& m : moments) {
    put.force += m.force;
    put.torque += m.torque;
  }
  spread_rest(put, delta, density);
}

// A rigid field of force a + b x r on the membrane that makes force and torque what they are.
void SharpTransfer::spread_rest(const Moments& put, MarkerTransfer& delta, fluid::FaceVector& density) {
  using Vector = Eigen::Vector3d;
  Vector force = Vector::Zero(), torque = Vector::Zero(), centre = Vector::Zero();
  double area = 0.0, size = 0.0;
  for (Eigen::Index m = 0; m < positions_.rows(); ++m) {
    const Vector x = positions_.row(m).transpose(), f = area_weight_[m] * Vector(force_.row(m).transpose());
    force += f;
    torque += x.cross(f);
    size += f.norm();
    area += area_weight_[m];
    centre += area_weight_[m] * x;
  }
  centre /= area;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (Eigen::Index m = 0; m < positions_.rows(); ++m) {
    const Vector r = Vector(positions_.row(m).transpose()) - centre;
    inertia += area_weight_[m] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  const Vector lacking = force - put.force;
  const Vector a = lacking / area;
  const Vector b = inertia.ldlt().solve(Vector(torque - put.torque - centre.cross(lacking)));
  lacking_force_ = size > 0.0 ? lacking.norm() / size : 0.0;
  rest_.resize(positions_.rows(), 3);
  for (Eigen::Index m = 0; m < positions_.rows(); ++m)
    rest_.row(m) = (a + b.cross(Vector(positions_.row(m).transpose()) - centre)).transpose();
  delta.spread(rest_, area_weight_, density);
}

void SharpTransfer::clear(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source) {
  const auto faces = density.points();
  for (std::size_t c = 0; c < 4; ++c) {
    const fluid::View& view = c == pressure_band ? source.points() : faces[c];
    for (const Box& box : touched_[c])
      for (int k = box.first[2]; k < box.first[2] + box.extent[2]; ++k)
        for (int j = box.first[1]; j < box.first[1] + box.extent[1]; ++j)
          for (int i = box.first[0]; i < box.first[0] + box.extent[0]; ++i) {
            const std::array<int, 3> index{wrapped(i, 0), wrapped(j, 1), wrapped(k, 2)};
            bool is_there = true;
            for (std::size_t axis = 0; axis < 3; ++axis)
              is_there = is_there && index[axis] >= 0 && index[axis] < view.extent[axis];
            if (is_there) view(index[0], index[1], index[2]) = 0.0;
          }
    touched_[c].clear();
  }
}

void SharpTransfer::interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const {
  const auto views = velocity.points();
#pragma omp parallel for schedule(static)
  for (Eigen::Index m = 0; m < positions_.rows(); ++m)
    for (int component = 0; component < 3; ++component) {
      const GridBand& band = bands_[static_cast<std::size_t>(component)];
      const fluid::ConstView& u = views[static_cast<std::size_t>(component)];
      const fluid::Vector3 origin =
          fluid::point_position(grid_, fluid::face_centrings[static_cast<std::size_t>(component)], 0, 0, 0);
      std::array<int, 3> first;
      std::array<std::array<double, 4>, 3> weight;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at =
            (positions_(m, static_cast<Eigen::Index>(axis)) - origin[axis]) / grid_.spacing(static_cast<int>(axis));
        const double below = std::floor(at);
        first[axis] = static_cast<int>(below) - 1;
        weight[axis] = lagrange(at - below);
      }
      double sum = 0.0;
      for (int c = 0; c < 4; ++c)
        for (int b = 0; b < 4; ++b) {
          const double w = weight[2][static_cast<std::size_t>(c)] * weight[1][static_cast<std::size_t>(b)];
          for (int a = 0; a < 4; ++a) {
            const int i = first[0] + a, j = first[1] + b, k = first[2] + c;
            const std::ptrdiff_t at = band.offset(i, j, k);
            const double half = 0.5 * band.jump(at);
            sum += w * weight[0][static_cast<std::size_t>(a)] *
                   (u(wrapped(i, 0), wrapped(j, 1), wrapped(k, 2)) + (band.is_inside(at) ? half : -half));
          }
        }
      marker_velocity(m, component) = sum;
    }
}

}  // namespace vesiflow::coupling
