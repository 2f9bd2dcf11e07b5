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
#include "transfer/roomy.h"
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

// Errors of a phase are multiplied by 1 - 2 s/3 in a step, s its acceleration over the solved one: by -2/3 with s = 2.5. From s = 3 on they
// would not decay, and runs with s = 3.3 blow up at once. A larger Re_s makes the other phase, of s << 1, slow to forget: with s = 2 and 1
// inside, a thin inside blows up from ever smaller Reynolds numbers on (ratio 0.05, dt = 1/48: 0.05 and less, against 0.1).
double PhaseInertia::solved_reynolds_number(double reynolds_number, double least_ratio) {
  constexpr double greatest_share = 2.5;
  return reynolds_number * std::max(1.0, 1.0 / (greatest_share * least_ratio));
}

PhaseInertia::Level::Level(const fluid::Grid& grid, bool convects) : outer(grid) {
  if (convects) convection.emplace_back(grid);
}

PhaseInertia::PhaseInertia(const fluid::Grid& grid, double reynolds_number, std::vector<Body> bodies, bool convects)
    : grid_(grid),
      bodies_(std::move(bodies)),
      reynolds_number_(reynolds_number),
      solved_(solved_reynolds_number(reynolds_number, std::ranges::min(bodies_, {}, &Body::ratio).ratio)),
      levels_{Level(grid, convects), Level(grid, convects), Level(grid, convects)},
      explicit_(grid) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) insides_.emplace_back(grid, convects);
}

void PhaseInertia::convect(Level& level) {
  if (!level.convection.empty()) fluid::convection(level.outer, level.convection[0]);
}

// 1 inside, 0 outside.
double PhaseInertia::blend(const Body& body, double distance) {
  return body.sharp->blend(distance / smoothing);
}

void PhaseInertia::begin(const fluid::FaceVector& velocity) {
  Level& level = levels_[now_];
  copy(velocity, level.outer);
  convect(level);  // the time before has coefficients of zero
  for (std::size_t b = 0; b < bodies_.size(); ++b) insides_[b].begin(*bodies_[b].sharp, bodies_[b].ratio, velocity);
}

PhaseInertia::Past PhaseInertia::past(const Coefficients& c, double velocity, double earlier, double convection,
                                      double earlier_convection, double viscosity) {
  const auto extrapolated = [&](double latest, double last) { return (1.0 + c.r) * latest - c.r * last; };
  return {extrapolated(velocity, earlier),
          c.c1 * velocity + c.c2 * earlier + extrapolated(convection, earlier_convection) / viscosity};
}

PhaseInertia::Past PhaseInertia::OuterPast::operator()(std::ptrdiff_t at) const {
  const bool convects = convection != nullptr;
  return past(c, velocity[at], earlier[at], convects ? convection[at] : 0.0, convects ? earlier_convection[at] : 0.0,
              1.0);
}

PhaseInertia::OuterPast PhaseInertia::outer_past(int component) const {
  const auto data = [component](const fluid::FaceVector& field) {
    return field.points()[static_cast<std::size_t>(component)].data;
  };
  const Level &level = levels_[now_], &earlier = levels_[before()];
  const bool convects = !level.convection.empty();
  return {c_, data(level.outer), data(earlier.outer), convects ? data(level.convection[0]) : nullptr,
          convects ? data(earlier.convection[0]) : nullptr};
}

// Of a body that has moved further than its bands reach, which the fluid does not follow, the point is not known.
std::optional<PhaseInertia::Past> PhaseInertia::inner_past(int component, std::size_t body,
                                                           const std::array<int, 3>& point) const {
  const InnerPhase& inside = insides_[body];
  if (!inside.has(now_, point) || !inside.has(before(), point)) return std::nullopt;
  const InnerPhase::Value value = inside.at(now_, component, point), earlier = inside.at(before(), component, point);
  return past(c_, value.velocity, earlier.velocity, value.convection, earlier.convection, bodies_[body].ratio);
}

double PhaseInertia::prepare(const fluid::NavierStokes& fluid, double dt) {
  const double r = fluid.steps() > 0 ? dt / fluid.clock().time_step : 0.0;
  c_ = {(1.0 + 2.0 * r) / (1.0 + r) / dt, -(1.0 + r) / dt, r * r / (1.0 + r) / dt, r};
  shared_.clear();
  for (const int c : components) {
    prepare_outside(c, fluid);
    for (std::size_t b = 0; b < bodies_.size(); ++b) prepare_inside(c, b, fluid);
    for (std::size_t b = 0; b < bodies_.size(); ++b) prepare_next_to(c, b);
  }
  return solved_ * c_.c0;
}

// As if there were no bodies.
void PhaseInertia::prepare_outside(int component, const fluid::NavierStokes& fluid) {
  const auto c = static_cast<std::size_t>(component);
  const OuterPast outer = outer_past(component);
  const fluid::ConstView velocity = fluid.velocity().points()[c], earlier = fluid.previous_velocity().points()[c];
  const fluid::View force = explicit_.points()[c], next = next_w().points()[c];
  in_shares(force.extent[2], [&](Eigen::Index begin, Eigen::Index end) {
    for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
      for (int j = 0; j < force.extent[1]; ++j)
        for (int i = 0; i < force.extent[0]; ++i) {
          const std::ptrdiff_t at = offset(force, i, j, k);
          const Past past = outer(at);
          next.data[at] = past.next;
          force.data[at] = (solved_ - reynolds_number_) * c_.c0 * past.next +
                           solved_ * (c_.c1 * velocity.data[at] + c_.c2 * earlier.data[at]) -
                           reynolds_number_ * past.acceleration;
        }
  });
}

// At the points inside of a body, with the outer phase where the smooth step lets it.
void PhaseInertia::prepare_inside(int component, std::size_t body, const fluid::NavierStokes& fluid) {
  const auto c = static_cast<std::size_t>(component);
  const double ratio = bodies_[body].ratio;
  const GridBand& band = bodies_[body].sharp->band(component);
  const OuterPast outer = outer_past(component);
  const fluid::ConstView velocity = fluid.velocity().points()[c], earlier = fluid.previous_velocity().points()[c];
  const fluid::View force = explicit_.points()[c], next = next_w().points()[c];
  const auto put = [&](const std::array<int, 3>& point, double theta) {
    const std::optional<Past> inner = inner_past(component, body, point);
    if (!inner) return;
    const double of_outer = (1.0 - theta) * reynolds_number_, of_inner = theta * reynolds_number_ / ratio;
    for_places(point, grid_, force.extent, [&](int i, int j, int k) {
      const std::ptrdiff_t at = offset(force, i, j, k);
      next.data[at] = inner->next;
      force.data[at] = (solved_ - of_outer - of_inner) * c_.c0 * inner->next +
                       solved_ * (c_.c1 * velocity.data[at] + c_.c2 * earlier.data[at]) -
                       of_inner * inner->acceleration;
      // Deeper inside the outer phase has no meaning.
      if (of_outer > 0.0) force.data[at] -= of_outer * outer(at).acceleration;
    });
  };
  inside_.find(band, grid_.spacing(0));
  for (const InsidePoints::Run& run : inside_.runs())
    for (int i = run.first; i < run.last; ++i) put({i, run.j, run.k}, 1.0);
  for_band(band, [&](const GridBand::Point& point) {
    if (band.is_inside(point.at)) put(point.index, blend(bodies_[body], point.distance()));
  });
}

// Outside of a body, but within the smooth step: a share of the outer phase becomes one of the body's, whatever the point is in.
void PhaseInertia::prepare_next_to(int component, std::size_t body) {
  const auto c = static_cast<std::size_t>(component);
  const double ratio = bodies_[body].ratio;
  const GridBand& band = bodies_[body].sharp->band(component);
  const OuterPast outer = outer_past(component);
  const fluid::View force = explicit_.points()[c];
  const fluid::ConstView next = std::as_const(next_w()).points()[c];
  for_band(band, [&](const GridBand::Point& point) {
    const double theta = blend(bodies_[body], point.distance());
    if (theta == 0.0 || band.is_inside(point.at)) return;
    const std::optional<Past> inner = inner_past(component, body, point.index);
    if (!inner) return;
    const double of_outer = theta * reynolds_number_, of_inner = of_outer / ratio;
    for_places(point.index, grid_, force.extent, [&](int i, int j, int k) {
      const std::ptrdiff_t at = offset(force, i, j, k);
      force.data[at] += (of_outer - of_inner) * c_.c0 * next.data[at] + of_outer * outer(at).acceleration -
                        of_inner * inner->acceleration;
    });
    find_shared(component, point, theta * (1.0 - 1.0 / ratio));
  });
}

// Such a point may be inside of another body, or of an image of its own.
void PhaseInertia::find_shared(int component, const GridBand::Point& point, double factor) {
  for (const Body& body : bodies_) {
    const GridBand& band = body.sharp->band(component);
    std::array<int, 3> first = point.index, step{1, 1, 1}, last = point.index;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int begin = band.first()[axis], end = begin + band.extent()[axis];
      if (grid_.periodic[axis]) {
        step[axis] = grid_.cells[axis];
        first[axis] = begin + ((point.index[axis] - begin) % step[axis] + step[axis]) % step[axis];
        last[axis] = end - 1;
      } else if (first[axis] < begin || first[axis] >= end) {
        last[axis] = first[axis] - 1;
      }
    }
    for (int k = first[2]; k <= last[2]; k += step[2])
      for (int j = first[1]; j <= last[1]; j += step[1])
        for (int i = first[0]; i <= last[0]; i += step[0]) {
          const std::ptrdiff_t at = band.offset(i, j, k);
          if (!band.is_inside(at)) continue;
          reserve_with_room(shared_, shared_.size() + 1);
          shared_.push_back({component, point.index, &band, at, factor});
        }
  }
}

void PhaseInertia::add_to(fluid::FaceVector& density) const {
  const auto prepared = explicit_.points();
  const auto all = density.points();
  const double of_jump = c_.c0 * reynolds_number_;
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
        const double theta = blend(body, point.distance());
        if (theta == 0.0 || theta == 1.0) return;
        const double share = band.is_inside(point.at) ? -(1.0 - theta) : theta / body.ratio;
        const double more = of_jump * share * band.jump(point.at);
        for_places(point.index, grid_, force.extent, [&](int i, int j, int k) { force(i, j, k) += more; });
      });
    }
  }
  for (const Shared& shared : shared_) {
    const fluid::View force = all[static_cast<std::size_t>(shared.component)];
    const double more = of_jump * shared.factor * shared.inside->jump(shared.at);
    for_places(shared.point, grid_, force.extent, [&](int i, int j, int k) { force(i, j, k) += more; });
  }
}

void PhaseInertia::keep(const fluid::FaceVector& velocity) {
  now_ = (now_ + 1) % 3;
  Level& level = levels_[now_];
  copy(velocity, level.outer);
  for (const Body& body : bodies_)
    for (const int c : components) {
      const GridBand& band = body.sharp->band(c);
      const fluid::View outer = level.outer.points()[static_cast<std::size_t>(c)];
      for_band(band, [&](const GridBand::Point& point) {
        if (!band.is_inside(point.at)) return;
        const double jump = band.jump(point.at);
        for_places(point.index, grid_, outer.extent, [&](int i, int j, int k) { outer(i, j, k) += jump; });
      });
    }
  convect(level);
  for (std::size_t b = 0; b < bodies_.size(); ++b) insides_[b].keep(now_, *bodies_[b].sharp, velocity, level.outer);
}

std::vector<fluid::FaceVector> PhaseInertia::outer_state() const {
  std::vector<fluid::FaceVector> state;
  for (const std::size_t level : {now_, before()}) state.push_back(levels_[level].outer.clone());
  return state;
}

std::array<std::vector<double>, 2> PhaseInertia::inner_state(std::size_t body) const {
  return {insides_[body].state(now_), insides_[body].state(before())};
}

void PhaseInertia::restore(std::span<const fluid::FaceVector> outer, std::span<const InnerState> inner,
                           const fluid::NavierStokes& fluid) {
  if (outer.size() != 2 || inner.size() != bodies_.size())
    throw std::invalid_argument(
        fmt::format("the state has {} velocities of the outer phase and those inside of {} vesicles, expected 2 and {}",
                    outer.size(), inner.size(), bodies_.size()));
  for (const fluid::FaceVector& field : outer)
    if (!(field.grid() == grid_) || !all_finite(field))
      throw std::invalid_argument("the velocity of a phase is not on the grid of the fluid, or not finite");
  now_ = remembered_ = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) insides_[b].restore(now_, inner[b][0], before(), inner[b][1]);
  for (const int back : {0, 1}) {
    Level& level = levels_[back == 0 ? now_ : before()];
    // Next to walls membranes do not reach, and ghosts there are those of the fluid.
    copy(back == 0 ? fluid.velocity() : fluid.previous_velocity(), level.outer);
    const auto from = outer[static_cast<std::size_t>(back)].points();
    for (const int c : components) {
      const fluid::ConstView source = from[static_cast<std::size_t>(c)];
      const fluid::View target = level.outer.points()[static_cast<std::size_t>(c)];
      for (int k = 0; k < source.extent[2]; ++k)
        for (int j = 0; j < source.extent[1]; ++j)
          for (int i = 0; i < source.extent[0]; ++i)
            for_places({i, j, k}, grid_, target.extent,
                       [&](int x, int y, int z) { target(x, y, z) = source(i, j, k); });
    }
    convect(level);
  }
}

}  // namespace vesiflow::coupling
