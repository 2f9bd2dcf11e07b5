#include "coupling/marker_transfer.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "coupling/delta_kernel.h"
#include "coupling/errors.h"

namespace vesiflow::coupling {
namespace {

// Along which axis a centring lies on faces; -1 for none.
template <class Centring>
constexpr int normal_axis = -1;
template <>
constexpr int normal_axis<fluid::FaceX> = 0;
template <>
constexpr int normal_axis<fluid::FaceY> = 1;
template <>
constexpr int normal_axis<fluid::FaceZ> = 2;

// 0 (faces) or 1 (centres): which of the two weight sets of an axis a centring uses.
template <class Centring>
constexpr int point_set(int axis) {
  return axis == normal_axis<Centring> ? 0 : 1;
}

[[noreturn]] void refuse_marker(Eigen::Index marker, int axis, double position, const fluid::Grid& grid) {
  const char* name[] = {"x", "y", "z"};
  throw SimulationStopped("marker " + std::to_string(marker) + " is at " + name[axis] + " = " +
                              std::to_string(position) + ", nearer than " +
                              std::to_string(MarkerTransfer::wall_distance) + " grid spacings to the wall (box " +
                              std::to_string(grid.lower[axis]) + " to " + std::to_string(grid.upper[axis]) + ")",
                          "move the vesicle away from the wall or enlarge the box (domain.lower, domain.upper)");
}

}  // namespace

MarkerTransfer::MarkerTransfer(const fluid::Grid& grid) : grid_(grid) {}

void MarkerTransfer::update(const Eigen::Ref<const vesicle::VectorField>& positions) {
  stencils_.resize(static_cast<std::size_t>(positions.rows()));
  box_.first.fill(std::numeric_limits<std::int32_t>::max());
  box_.last.fill(std::numeric_limits<std::int32_t>::min());
  for (int axis = 0; axis < 3; ++axis) {
    const double per_spacing = 1.0 / grid_.spacing(axis);
    const double upper = grid_.cells[axis] - wall_distance;
    for (Eigen::Index m = 0; m < positions.rows(); ++m) {
      const double s = (positions(m, axis) - grid_.lower[axis]) * per_spacing;
      if (!(s >= wall_distance && s < upper)) refuse_marker(m, axis, positions(m, axis), grid_);
      Stencil& stencil = stencils_[static_cast<std::size_t>(m)];
      for (int set = 0; set < 2; ++set) {
        const double below = std::floor(s - 0.5 * set);
        const auto first = static_cast<std::int32_t>(below) - 1;
        stencil.first[axis][set] = first;
        stencil.weights[axis][set] = smoothed_delta_weights(s - 0.5 * set - below);
        box_.first[axis] = std::min(box_.first[axis], first);
        box_.last[axis] = std::max(box_.last[axis], first + 3);
      }
    }
  }
}

// Each thread owns a range of planes and goes through all markers in order, so every grid point receives its
// contributions in the same order whatever the number of threads.
template <class Centring>
void MarkerTransfer::spread_component(int component, const vesicle::VectorField& force,
                                      const vesicle::ScalarField& area_weight, fluid::Field<Centring>& density) const {
  const double per_volume = 1.0 / grid_.cell_volume();
  constexpr int set_x = point_set<Centring>(0), set_y = point_set<Centring>(1), set_z = point_set<Centring>(2);
#pragma omp parallel
  {
    const int threads = omp_get_num_threads();
    const int planes = box_.last[2] - box_.first[2] + 1;
    const int own_first = box_.first[2] + planes * omp_get_thread_num() / threads;
    const int own_last = box_.first[2] + planes * (omp_get_thread_num() + 1) / threads - 1;
    for (std::size_t m = 0; m < stencils_.size(); ++m) {
      const Stencil& s = stencils_[m];
      const int z0 = s.first[2][set_z];
      const int k_first = std::max(0, own_first - z0), k_last = std::min(3, own_last - z0);
      if (k_first > k_last) continue;
      const auto row_of_marker = static_cast<Eigen::Index>(m);
      const double strength = force(row_of_marker, component) * area_weight(row_of_marker) * per_volume;
      const auto& wx = s.weights[0][set_x];
      for (int k = k_first; k <= k_last; ++k) {
        for (int j = 0; j < 4; ++j) {
          const double w = strength * s.weights[2][set_z][k] * s.weights[1][set_y][j];
          double* row = density.row(s.first[1][set_y] + j, z0 + k) + s.first[0][set_x];
          for (int i = 0; i < 4; ++i) row[i] += w * wx[i];
        }
      }
    }
  }
}

template <class Centring>
void MarkerTransfer::interpolate_component(int component, const fluid::Field<Centring>& velocity,
                                           vesicle::VectorField& marker_velocity) const {
  constexpr int set_x = point_set<Centring>(0), set_y = point_set<Centring>(1), set_z = point_set<Centring>(2);
#pragma omp parallel for schedule(static)
  for (std::size_t m = 0; m < stencils_.size(); ++m) {
    const Stencil& s = stencils_[m];
    std::array<double, 4> along_x{};
    for (int k = 0; k < 4; ++k) {
      for (int j = 0; j < 4; ++j) {
        const double w = s.weights[2][set_z][k] * s.weights[1][set_y][j];
        const double* row = velocity.row(s.first[1][set_y] + j, s.first[2][set_z] + k) + s.first[0][set_x];
        for (int i = 0; i < 4; ++i) along_x[i] += w * row[i];
      }
    }
    const auto& wx = s.weights[0][set_x];
    marker_velocity(static_cast<Eigen::Index>(m), component) =
        (along_x[0] * wx[0] + along_x[1] * wx[1]) + (along_x[2] * wx[2] + along_x[3] * wx[3]);
  }
}

template <class Centring>
void MarkerTransfer::clear_component(fluid::Field<Centring>& density) const {
  const int length = spread_box_.last[0] - spread_box_.first[0] + 1;
#pragma omp parallel for schedule(static)
  for (int k = spread_box_.first[2]; k <= spread_box_.last[2]; ++k) {
    for (int j = spread_box_.first[1]; j <= spread_box_.last[1]; ++j)
      std::fill_n(&density(spread_box_.first[0], j, k), length, 0.0);
  }
}

void MarkerTransfer::spread(const vesicle::VectorField& force, const vesicle::ScalarField& area_weight,
                            fluid::FaceVector& density) {
  spread_box_ = box_;
  spread_component(0, force, area_weight, density.x);
  spread_component(1, force, area_weight, density.y);
  spread_component(2, force, area_weight, density.z);
}

void MarkerTransfer::interpolate(const fluid::FaceVector& velocity, vesicle::VectorField& marker_velocity) const {
  interpolate_component(0, velocity.x, marker_velocity);
  interpolate_component(1, velocity.y, marker_velocity);
  interpolate_component(2, velocity.z, marker_velocity);
}

void MarkerTransfer::clear(fluid::FaceVector& density) const {
  clear_component(density.x);
  clear_component(density.y);
  clear_component(density.z);
}

}  // namespace vesiflow::coupling
