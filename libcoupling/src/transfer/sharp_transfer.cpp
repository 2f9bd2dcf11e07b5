// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/sharp_transfer.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "transfer/shares.h"

namespace vesiflow::coupling {
namespace {

/// Nodes of the mesh that jumps are looked up on, in spacings of the grid.
constexpr double node_distance = 0.9;
/// More than rounding, in spacings.
constexpr double slack = 1e-9;
constexpr int pressure_band = 3;

/// Records of FineSurface: [u_i], [u_i]_n, [u_i]_nn, [u_i]_nnn of the components, and those of p.
std::vector<int> make_slots(bool velocity_jump) {
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

const std::vector<int>& slots(bool velocity_jump) {
  static const std::vector<int> without = make_slots(false), with = make_slots(true);
  return velocity_jump ? with : without;
}

/// Of Lagrange's polynomials for the nodes -1, 0, 1, 2, at 0 <= x < 1.
Eigen::Array4d lagrange(double x) {
  const double before = x + 1.0, after = x - 1.0, last = x - 2.0;
  constexpr double sixth = 1.0 / 6.0;
  return {-sixth * x * (after * last), 0.5 * before * (after * last), -0.5 * before * (x * last),
          sixth * before * (x * after)};
}

// Of integral_beyond_sum(), in spacings: within what all points of the velocity's bands are known to.
constexpr double counting_width = 2.0;

// From 1 at -1 to 0 at 1, with two continuous derivatives; the integral of x (H(-x) - step) vanishes.
double moment_free_step(double x) {
  const double y = x * x;
  return 0.5 + x * (-105.0 + y * (175.0 + y * (-147.0 + y * 45.0))) / 64.0;
}

}  // namespace

SharpTransfer::SharpTransfer(const fluid::Grid& grid, const vesicle::SphereGrid& markers, const Parameters& parameters)
    : grid_(grid),
      smoothing_(parameters.smoothing * grid.min_spacing()),
      spacing_(std::max({grid.spacing(0), grid.spacing(1), grid.spacing(2)})),
      more_reach_(parameters.more_reach),
      jumps_(markers, {.degrees = parameters.degrees, .jump_degrees = markers.latitudes(), .cut = {}}),
      fine_(4) {
  for (int axis = 0; axis < 3; ++axis) {
    per_spacing_[axis] = 1.0 / grid.spacing(axis);
    across_[axis] = grid.mirror[axis] && parameters.across[axis];
  }
  for (const fluid::Centring centring : fluid::face_centrings) bands_.emplace_back(grid, centring, across_);
  bands_.emplace_back(grid, fluid::Centring::cell, across_);
}

void SharpTransfer::update(const vesicle::Surface& surface, bool has_neighbours, double more_reach) {
  jumps_.update(surface);
  fine_.update(surface, node_distance * grid_.min_spacing());
  positions_ = surface.positions();
  readers_ = positions_;
  for (int axis = 0; axis < 3; ++axis)
    if (across_[axis]) readers_.col(axis) = grid_.lower[axis] + (positions_.col(axis) - grid_.lower[axis]).abs();
  area_weight_ = surface.area_weight();
  // f is at faces within reach, whose differences take in the next faces and the cells on both sides; r is at cells
  // within reach at most, and takes in the faces on both sides.
  const double reach = force_reach();
  // A neighbour's marker outside reads no deeper inside than the diagonal of what it reads along the axes.
  const double velocity_reach = std::max(reach + (std::min(more_reach, more_reach_) + 1.0 + slack) * spacing_,
                                         has_neighbours ? std::sqrt(3.0) * reading_reach() : 0.0);
  for (std::size_t c = 0; c < 3; ++c) bands_[c].update(fine_, velocity_reach, &readers_);
  bands_[pressure_band].update(fine_, reach + (0.5 + slack) * spacing_);
}

void SharpTransfer::set_force(const vesicle::VectorField& force, const vesicle::VectorField* velocity_jump) {
  if (velocity_jump != nullptr)
    jumps_.compute(force, *velocity_jump);
  else
    jumps_.compute(force);
  fine_.set(jumps_.coefficients(), slots(velocity_jump != nullptr));
  for (int c = 0; c < 4; ++c) bands_[static_cast<std::size_t>(c)].evaluate(fine_, FineSurface::jumps + c);
  force_ = force;
}

void SharpTransfer::read_past(const SharpTransfer& other) {
  for (std::size_t c = 0; c < 3; ++c) bands_[c].read_past(other.bands_[c]);
}

// 1 inside, 0 outside.
double SharpTransfer::blend(double d) const {
  const double x = std::clamp(0.5 * (1.0 - d / smoothing_), 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}

// Beyond, theta is chi at a point and at all that its differences take in.
double SharpTransfer::force_reach() const {
  return std::max(smoothing_, spacing_) + slack * spacing_;
}
double SharpTransfer::source_reach() const {
  return std::max(smoothing_, 0.5 * spacing_) + slack * spacing_;
}

// (chi - theta) D.
double SharpTransfer::corrected(const GridBand& band, std::ptrdiff_t at, double theta) {
  return band.to_mean(at) + (0.5 - theta) * band.jump(at);
}

// M(chi D) - theta M(D) at a point: every arm of the stencil takes (chi - theta) D at its end.
double SharpTransfer::momentum_at(int component, const GridBand::Point& point) const {
  const GridBand& u = bands_[static_cast<std::size_t>(component)];
  const GridBand& p = bands_[pressure_band];
  const double theta = blend(point.distance());
  const double twice_here = 2.0 * corrected(u, point.at, theta);
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::ptrdiff_t next = u.stride(axis);
    const double ends = corrected(u, point.at + next, theta) + corrected(u, point.at - next, theta);
    sum += (ends - twice_here) * per_spacing_[axis] * per_spacing_[axis];
  }
  // A face lies between the cell below it, of the index before, and the one of its own.
  const std::ptrdiff_t above = p.offset(point.index[0], point.index[1], point.index[2]);
  const std::ptrdiff_t below = above - p.stride(component);
  return sum - (corrected(p, above, theta) - corrected(p, below, theta)) * per_spacing_[component];
}

// -div(chi D) + theta div(D) at a point.
double SharpTransfer::source_at(const GridBand::Point& point) const {
  const double theta = blend(point.distance());
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const GridBand& u = bands_[static_cast<std::size_t>(axis)];
    const std::ptrdiff_t below = u.offset(point.index[0], point.index[1], point.index[2]);
    sum -= (corrected(u, below + u.stride(axis), theta) - corrected(u, below, theta)) * per_spacing_[axis];
  }
  return sum;
}

// add(point, where it is in the grid, what a value there counts).
template <class Add>
void SharpTransfer::for_points_within(double reach, const GridBand& band, const Add& add) {
  for (const GridBand::Point& point : band.points()) {
    if (!(std::abs(point.distance()) <= reach && band.is_on_side(point.index))) continue;
    std::array<int, 3> in_grid;
    double sign = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      in_grid[axis] = band.in_grid(axis, point.index[axis]);
      sign *= band.sign(axis, point.index[axis]);
    }
    add(point, in_grid, sign);
  }
}

void SharpTransfer::add_component(int component, const fluid::View& density, Moments& moments) const {
  const GridBand& band = bands_[static_cast<std::size_t>(component)];
  double force = 0.0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for_points_within(force_reach(), band,
                    [&](const GridBand::Point& point, const std::array<int, 3>& in_grid, double sign) {
                      const double f = momentum_at(component, point);
                      density(in_grid[0], in_grid[1], in_grid[2]) += sign * f;
                      force += f;
                      at += f * band.position(point.index);
                    });
  // The other side of mirror planes that the membrane lies across.
  for (int axis = 0; axis < 3; ++axis) {
    if (!across_[axis]) continue;
    const double sign = axis == component ? -1.0 : 1.0;
    Eigen::Vector3d image = sign * at;
    image[axis] = sign * 2.0 * grid_.lower[axis] * force - image[axis];
    force += sign * force;
    at += image;
  }
  const double volume = grid_.cell_volume();
  moments.force[component] = volume * force;
  moments.torque = volume * at.cross(Eigen::Vector3d::Unit(component));
}

void SharpTransfer::add_source(const fluid::View& source) const {
  for_points_within(source_reach(), bands_[pressure_band],
                    [&](const GridBand::Point& point, const std::array<int, 3>& in_grid, double sign) {
                      source(in_grid[0], in_grid[1], in_grid[2]) += sign * source_at(point);
                    });
}

void SharpTransfer::add_to(fluid::FaceVector& density, fluid::Field<fluid::Cell>& source, MarkerTransfer& delta) {
  std::array<Moments, 3> moments;
  const auto views = density.points();
  in_shares(4, [&](Eigen::Index begin, Eigen::Index end) {
    for (auto c = static_cast<int>(begin); c < static_cast<int>(end); ++c)
      if (c == pressure_band)
        add_source(source.points());
      else
        add_component(c, views[static_cast<std::size_t>(c)], moments[static_cast<std::size_t>(c)]);
  });
  for (std::size_t c = 0; c < 4; ++c) {
    const Box box{bands_[c].first(), bands_[c].extent()};
    if (std::ranges::find(touched_[c], box) == touched_[c].end()) touched_[c].push_back(box);
  }
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
    for (const Box& box : touched_[c]) clear_box(box, c == pressure_band ? source.points() : faces[c]);
    touched_[c].clear();
  }
}

void SharpTransfer::clear_box(const Box& box, const fluid::View& view) const {
  // Two ranges of an axis: the second is what goes on at the other end.
  std::array<std::array<std::array<int, 2>, 2>, 3> ranges;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int first = box.first[axis], cells = grid_.cells[axis];
    int end = first + box.extent[axis];
    if (grid_.mirror[axis]) end = std::max(end, 1 - first);  // what is put beyond the plane is put at its mirror image
    if (!grid_.periodic[axis]) {
      ranges[axis] = {{{std::max(first, 0), std::min(end, view.extent[axis])}, {0, 0}}};
    } else {
      const int begin = ((first % cells) + cells) % cells, count = std::min(end - first, cells);
      ranges[axis] = {{{begin, std::min(begin + count, cells)}, {0, std::max(0, begin + count - cells)}}};
    }
  }
  for (const auto& [k_begin, k_end] : ranges[2])
    for (int k = k_begin; k < k_end; ++k)
      for (const auto& [j_begin, j_end] : ranges[1])
        for (int j = j_begin; j < j_end; ++j)
          for (const auto& [i_begin, i_end] : ranges[0])
            if (i_begin < i_end) std::fill(view.row(j, k) + i_begin, view.row(j, k) + i_end, 0.0);
}

void SharpTransfer::interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const {
  const auto views = velocity.points();
  in_shares(positions_.rows(), [&](Eigen::Index begin, Eigen::Index end) {
    for (std::size_t c = 0; c < 3; ++c)
      for (Eigen::Index m = begin; m < end; ++m)
        marker_velocity(m, static_cast<Eigen::Index>(c)) = mean_of_sides(bands_[c], views[c], m);
    for (int axis = 0; axis < 3; ++axis)
      for (Eigen::Index m = begin; across_[axis] && m < end; ++m)
        if (positions_(m, axis) < grid_.lower[axis]) marker_velocity(m, axis) = -marker_velocity(m, axis);
  });
}

// The velocity is a smooth field less chi g, g the jump. Where a wide step replaces chi, a sum over points is the integral
// to high order: what it is beyond that is the sum of (chi - step) g, whose integral vanishes to the fourth order if the
// first moment of chi - step does, the zeroth being zero for any odd step.
Eigen::Vector3d SharpTransfer::integral_beyond_sum() const {
  const double width = counting_width * spacing_;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    const GridBand& band = bands_[static_cast<std::size_t>(c)];
    for (const GridBand::Point& point : band.points()) {
      const double d = point.distance();
      if (std::abs(d) < width) sum[c] += ((d < 0.0 ? 1.0 : 0.0) - moment_free_step(d / width)) * band.jump(point.at);
    }
  }
  return grid_.cell_volume() * sum;
}

double SharpTransfer::mean_of_sides(const GridBand& band, const fluid::ConstView& u, Eigen::Index marker) const {
  using Four = Eigen::Array4d;
  constexpr int width = GridBand::read_points;
  static_assert(width == Four::SizeAtCompileTime);
  std::array<int, 3> first;
  std::array<Four, 3> weight, sign;
  for (int axis = 0; axis < 3; ++axis) {
    const GridBand::Reading reading = band.reading(axis, readers_(marker, axis));
    first[axis] = reading.first;
    weight[axis] = lagrange(reading.fraction);
    for (int a = 0; a < width; ++a) sign[axis][a] = band.sign(axis, first[axis] + a);
  }
  std::array<std::ptrdiff_t, width> columns, rows, planes;
  for (int a = 0; a < width; ++a) {
    columns[a] = band.in_grid(0, first[0] + a);
    rows[a] = band.in_grid(1, first[1] + a) * u.row_stride;
    planes[a] = band.in_grid(2, first[2] + a) * u.plane_stride;
  }
  const bool is_whole = columns[width - 1] - columns[0] == width - 1 && sign[0][0] == 1.0;
  const double* to_read = band.to_read(first[0], first[1], first[2]);
  Four sum = Four::Zero();
  for (int c = 0; c < width; ++c)
    for (int b = 0; b < width; ++b) {
      const double* row = u.data + planes[c] + rows[b];
      Four value;
      if (is_whole)
        value = Eigen::Map<const Four>(row + columns[0]);
      else
        for (int a = 0; a < width; ++a) value[a] = sign[0][a] * row[columns[a]];
      value =
          sign[2][c] * sign[1][b] * value + Eigen::Map<const Four>(to_read + c * band.stride(2) + b * band.stride(1));
      sum += weight[2][c] * weight[1][b] * value;
    }
  return (sum * weight[0]).sum();
}

}  // namespace vesiflow::coupling
