// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/phase_inertia.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "transfer/shares.h"
#include "viscosity/grid_places.h"

namespace vesiflow::coupling {
namespace {

constexpr std::array<int, 3> components{0, 1, 2};

std::ptrdiff_t offset(const fluid::ConstView& view, int i, int j, int k) {
  return i + j * view.row_stride + k * view.plane_stride;
}

void copy(const fluid::FaceVector& from, fluid::FaceVector& to) {
  std::copy_n(from.x.data(), from.x.size(), to.x.data());
  std::copy_n(from.y.data(), from.y.size(), to.y.data());
  std::copy_n(from.z.data(), from.z.size(), to.z.data());
}

/// Whether all points are, ghosts apart.
bool all_finite(const fluid::FaceVector& field) {
  return std::ranges::all_of(field.points(), [](const fluid::ConstView& view) {
    for (int k = 0; k < view.extent[2]; ++k)
      for (int j = 0; j < view.extent[1]; ++j)
        if (!std::all_of(view.row(j, k), view.row(j, k) + view.extent[0], [](double x) { return std::isfinite(x); }))
          return false;
    return true;
  });
}

/// work(point) for the points of the band.
template <class Work>
void for_band(const GridBand& band, const Work& work) {
  for (const GridBand::Point& point : band.points())
    if (point.distance() != GridBand::far) work(point);
}

}  // namespace

// Errors of a phase are multiplied by 1 - 2 s/3 in a step, s its acceleration over the solved one: by -1/3 with s = 2, which is as good as the
// 1/3 of BDF2 itself, s = 1. From s = 3 on they would not decay. A larger Re_s leaves more to be extrapolated: with s = 1 inside at ratio 0.2,
// Re = 1, dt = 1/24 stiff membranes blow up.
double PhaseInertia::solved_reynolds_number(double reynolds_number, double least_ratio) {
  return reynolds_number * std::max(1.0, 0.5 / least_ratio);
}

PhaseInertia::Level::Level(const fluid::Grid& grid, bool convects) : outer(grid), inner(grid) {
  for (int phase = 0; convects && phase < 2; ++phase) convection.emplace_back(grid);
}

PhaseInertia::PhaseInertia(const fluid::Grid& grid, double reynolds_number, std::vector<Body> bodies, bool convects)
    : grid_(grid),
      bodies_(std::move(bodies)),
      reynolds_number_(reynolds_number),
      solved_(solved_reynolds_number(reynolds_number, std::ranges::min(bodies_, {}, &Body::ratio).ratio)),
      levels_{Level(grid, convects), Level(grid, convects), Level(grid, convects)},
      explicit_(grid) {}

void PhaseInertia::convect(Level& level) {
  if (level.convection.empty()) return;
  fluid::convection(level.outer, level.convection[0]);
  fluid::convection(level.inner, level.convection[1]);
}

void PhaseInertia::begin(const fluid::FaceVector& velocity) {
  Level& level = levels_[now_];
  copy(velocity, level.outer);
  copy(velocity, level.inner);
  for (const Body& body : bodies_)
    for (const int c : components) {
      const GridBand& band = body.sharp->band(c);
      const fluid::View inner = level.inner.points()[static_cast<std::size_t>(c)];
      inside_.find(band, grid_.spacing(0));
      inside_.multiply(body.ratio, grid_, inner);
      for_band(band, [&](const GridBand::Point& point) {
        if (!band.is_inside(point.at))
          for_places(point.index, grid_, inner.extent, [&](int i, int j, int k) { inner(i, j, k) *= body.ratio; });
      });
    }
  convect(level);  // the time before has coefficients of zero
}

double PhaseInertia::ForceAt::operator()(std::ptrdiff_t at, bool inside, double theta, double ratio) const {
  const double of_outer = (1.0 - theta) * reynolds_number, of_inner = theta * reynolds_number / ratio;
  const auto extrapolated = [&](const double* latest, const double* earlier) {
    return (1.0 + c.r) * latest[at] - c.r * earlier[at];
  };
  const double next = inside ? extrapolated(inner, inner_before) : extrapolated(outer, outer_before);
  double force = (solved - of_outer - of_inner) * c.c0 * next + solved * (c.c1 * velocity[at] + c.c2 * before[at]);
  const auto subtract = [&](double factor, const double* latest, const double* earlier, const double* convection,
                            const double* convection_before, double viscosity) {
    if (factor == 0.0) return;  // where a phase is not continued to, it has no meaning
    double acceleration = c.c1 * latest[at] + c.c2 * earlier[at];
    if (convection != nullptr) acceleration += extrapolated(convection, convection_before) / viscosity;
    force -= factor * acceleration;
  };
  subtract(of_outer, outer, outer_before, outer_convection, outer_convection_before, 1.0);
  subtract(of_inner, inner, inner_before, inner_convection, inner_convection_before, ratio);
  return force;
}

PhaseInertia::ForceAt PhaseInertia::force_at(int component, const fluid::NavierStokes& fluid) const {
  const auto data = [component](const fluid::FaceVector& field) {
    return field.points()[static_cast<std::size_t>(component)].data;
  };
  const Level& level = levels_[now_];
  const Level& earlier = levels_[(now_ + 2) % 3];
  ForceAt force{.c = c_,
                .reynolds_number = reynolds_number_,
                .solved = solved_,
                .velocity = data(fluid.velocity()),
                .before = data(fluid.previous_velocity()),
                .outer = data(level.outer),
                .inner = data(level.inner),
                .outer_before = data(earlier.outer),
                .inner_before = data(earlier.inner)};
  if (level.convection.empty()) return force;
  force.outer_convection = data(level.convection[0]);
  force.inner_convection = data(level.convection[1]);
  force.outer_convection_before = data(earlier.convection[0]);
  force.inner_convection_before = data(earlier.convection[1]);
  return force;
}

double PhaseInertia::prepare(const fluid::NavierStokes& fluid, double dt) {
  const double r = fluid.steps() > 0 ? dt / fluid.clock().time_step : 0.0;
  c_ = {(1.0 + 2.0 * r) / (1.0 + r) / dt, -(1.0 + r) / dt, r * r / (1.0 + r) / dt, r};
  for (const int c : components) {
    const fluid::View force = explicit_.points()[static_cast<std::size_t>(c)];
    const ForceAt at_point = force_at(c, fluid);
    in_shares(force.extent[2], [&](Eigen::Index begin, Eigen::Index end) {
      for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
        for (int j = 0; j < force.extent[1]; ++j)
          for (int i = 0; i < force.extent[0]; ++i) force(i, j, k) = at_point(offset(force, i, j, k), false, 0.0, 1.0);
    });
    for (const Body& body : bodies_) {
      const GridBand& band = body.sharp->band(c);
      const auto put = [&](const std::array<int, 3>& point, bool inside, double theta) {
        for_places(point, grid_, force.extent, [&](int i, int j, int k) {
          force(i, j, k) = at_point(offset(force, i, j, k), inside, theta, body.ratio);
        });
      };
      inside_.find(band, grid_.spacing(0));
      for (const InsidePoints::Run& run : inside_.runs())
        for (int i = run.first; i < run.last; ++i) put({i, run.j, run.k}, true, 1.0);
      for_band(band, [&](const GridBand::Point& point) {
        const double theta = body.sharp->blend(point.distance());
        if (theta > 0.0) put(point.index, band.is_inside(point.at), theta);
      });
    }
  }
  return solved_ * c_.c0;
}

void PhaseInertia::add_to(fluid::FaceVector& density) const {
  const auto prepared = explicit_.points();
  const auto all = density.points();
  for (const int c : components) {
    const fluid::View force = all[static_cast<std::size_t>(c)];
    const fluid::ConstView from = prepared[static_cast<std::size_t>(c)];
    in_shares(force.extent[2], [&](Eigen::Index begin, Eigen::Index end) {
      for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
        for (int j = 0; j < force.extent[1]; ++j)
          std::transform(from.row(j, k), from.row(j, k) + force.extent[0], force.row(j, k), force.row(j, k),
                         std::plus<>());
    });
    // The two phases of the new time, by which the grid's is not the one meant.
    for (const Body& body : bodies_) {
      const GridBand& band = body.sharp->band(c);
      for_band(band, [&](const GridBand::Point& point) {
        const double theta = body.sharp->blend(point.distance());
        if (theta == 0.0 || theta == 1.0) return;
        const double share = band.is_inside(point.at) ? -(1.0 - theta) : theta / body.ratio;
        const double more = c_.c0 * reynolds_number_ * share * band.jump(point.at);
        for_places(point.index, grid_, force.extent, [&](int i, int j, int k) { force(i, j, k) += more; });
      });
    }
  }
}

void PhaseInertia::keep(const fluid::FaceVector& velocity) {
  now_ = (now_ + 1) % 3;
  Level& level = levels_[now_];
  copy(velocity, level.outer);
  copy(velocity, level.inner);
  for (const Body& body : bodies_)
    for (const int c : components) {
      const GridBand& band = body.sharp->band(c);
      const fluid::View outer = level.outer.points()[static_cast<std::size_t>(c)];
      const fluid::View inner = level.inner.points()[static_cast<std::size_t>(c)];
      for_band(band, [&](const GridBand::Point& point) {
        const bool inside = band.is_inside(point.at);
        const double jump = band.jump(point.at);
        for_places(point.index, grid_, outer.extent, [&](int i, int j, int k) {
          if (inside)
            outer(i, j, k) += jump;
          else
            inner(i, j, k) -= jump;
        });
      });
    }
  convect(level);
}

std::vector<fluid::FaceVector> PhaseInertia::state() const {
  std::vector<fluid::FaceVector> state;
  for (const std::size_t level : {now_, (now_ + 2) % 3}) {
    state.push_back(levels_[level].outer.clone());
    state.push_back(levels_[level].inner.clone());
  }
  return state;
}

void PhaseInertia::restore(const std::vector<fluid::FaceVector>& state, const fluid::NavierStokes& fluid) {
  if (state.size() != 4)
    throw std::invalid_argument(fmt::format("the state has {} velocities of phases, expected 4", state.size()));
  for (const fluid::FaceVector& field : state)
    if (!(field.grid() == grid_) || !all_finite(field))
      throw std::invalid_argument("a velocity of a phase is not on the grid of the fluid, or not finite");
  now_ = remembered_ = 0;
  for (const int back : {0, 1}) {
    Level& level = levels_[back == 0 ? 0 : 2];
    // Next to walls membranes do not reach, and ghosts there are those of the fluid.
    const fluid::FaceVector& whole = back == 0 ? fluid.velocity() : fluid.previous_velocity();
    for (const int phase : {0, 1}) {
      fluid::FaceVector& to = phase == 0 ? level.outer : level.inner;
      copy(whole, to);
      const auto from = state[static_cast<std::size_t>(2 * back + phase)].points();
      for (const int c : components) {
        const fluid::ConstView source = from[static_cast<std::size_t>(c)];
        const fluid::View target = to.points()[static_cast<std::size_t>(c)];
        for (int k = 0; k < source.extent[2]; ++k)
          for (int j = 0; j < source.extent[1]; ++j)
            for (int i = 0; i < source.extent[0]; ++i)
              for_places({i, j, k}, grid_, target.extent,
                         [&](int x, int y, int z) { target(x, y, z) = source(i, j, k); });
      }
    }
    convect(level);
  }
}

}  // namespace vesiflow::coupling
