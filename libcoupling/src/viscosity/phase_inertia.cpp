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
#include "viscosity/copy_field.h"
#include "viscosity/grid_places.h"

namespace vesiflow::coupling {
namespace {

std::ptrdiff_t offset(const fluid::ConstView& view, int i, int j, int k) {
  return i + j * view.row_stride + k * view.plane_stride;
}

constexpr std::array<std::size_t, 3> components{0, 1, 2};

/// Where along an axis a field of the grid has the point that a solver reads, or nowhere: across a periodic axis points
/// repeat, and what lies beyond mirrors and walls has none.
constexpr int nowhere = -1;
int place_of(int point, std::size_t axis, const fluid::Grid& grid, int extent) {
  const int cells = grid.cells[axis];
  if (grid.periodic[axis]) return ((point % cells) + cells) % cells;
  return point >= 0 && point < extent ? point : nowhere;
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

/// The range of a row beyond which all numbers are zero.
std::pair<int, int> without_zeros(const double* row, int count) {
  int begin = 0, end = count;
  while (begin < end && row[begin] == 0.0) ++begin;
  while (begin < end && row[end - 1] == 0.0) --end;
  return {begin, end};
}

/// work(point) for the points of the band.
template <class Work>
void for_band(const GridBand& band, const Work& work) {
  for (const GridBand::Point& point : band.points())
    if (point.distance() != GridBand::far) work(point);
}

}  // namespace

PhaseInertia::PhaseInertia(const fluid::Grid& grid, double reynolds_number, const PhaseSplitting& splitting,
                           std::vector<Body> bodies, bool convects)
    : grid_(grid),
      bodies_(std::move(bodies)),
      reynolds_number_(reynolds_number),
      splitting_(splitting),
      explicit_(grid),
      next_(grid),
      continuation_(grid) {
  c_.convects = convects;
  for (std::size_t b = 0; b < bodies_.size(); ++b) phases_.emplace_back(grid, convects);
  for (Component& component : components_) component.bodies.resize(bodies_.size());
  for (std::size_t time = 0; solves_another() && time < 3; ++time) {
    if (convects) convection_.emplace_back(grid);
    if (splitting_.curvature > 0.0) earlier_.emplace_back(grid);
  }
}

// 1 inside, 0 outside.
double PhaseInertia::blend(const Body& body, double distance) {
  return body.sharp->blend(distance / smoothing);
}

void PhaseInertia::begin(const fluid::FaceVector& velocity) {
  steps_.fill(0.0);
  keep_convection(0, velocity);  // the time before has coefficients of zero
  for (std::size_t b = 0; b < bodies_.size(); ++b) phases_[b].begin(*bodies_[b].sharp, bodies_[b].ratio, velocity);
}

void PhaseInertia::keep_convection(std::size_t back, const fluid::FaceVector& velocity) {
  if (!convection_.empty()) fluid::convection(velocity, convection_[(now_ - back) % convection_.size()]);
}

// Of a step dt after one of length `last` (0: none).
PhaseInertia::Coefficients PhaseInertia::coefficients(double dt, double last) const {
  const double r = last > 0.0 ? dt / last : 0.0;
  Coefficients c{.c0 = (1.0 + 2.0 * r) / (1.0 + r) / dt,
                 .c1 = -(1.0 + r) / dt,
                 .c2 = r * r / (1.0 + r) / dt,
                 .r = r,
                 .next = 1.0 + r,
                 .next1 = -r,
                 .convects = c_.convects};
  if (const double one_before = earlier_step(); last > 0.0 && one_before > 0.0) {  // Newton's divided differences
    const double second = splitting_.curvature * dt * (dt + last) / (last + one_before);
    c.next += second / last;
    c.next1 -= second / last + second / one_before;
    c.next2 = second / one_before;
  }
  return c;
}

double PhaseInertia::prepare(const fluid::NavierStokes& fluid, double dt) {
  c_ = coefficients(dt, fluid.steps() > 0 ? fluid.clock().time_step : 0.0);
  // What is the last but two in the next step.
  if (!earlier_.empty()) copy_field(fluid.previous_velocity(), earlier_[(now_ - 1) % earlier_.size()]);
  in_shares(3, [&](Eigen::Index begin, Eigen::Index end) {
    for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) prepare_component(c, fluid);
  });
  return splitting_.solved_reynolds_number * c_.c0;
}

// w as the grid has it, on the whole grid.
PhaseInertia::Levels PhaseInertia::everywhere(std::size_t component, const fluid::NavierStokes& fluid) const {
  const auto data = [component](const fluid::FaceVector& field) { return field.points()[component].data; };
  const double *velocity = data(fluid.velocity()), *earlier = data(fluid.previous_velocity());
  const double* earliest =
      earlier_.empty() || known_times() < 3 ? earlier : data(earlier_[(now_ - 2) % earlier_.size()]);
  if (convection_.empty()) return {velocity, earlier, earliest, velocity, earlier};
  const auto convection = [&](std::size_t back) { return data(convection_[(now_ - back) % convection_.size()]); };
  return {velocity, earlier, earliest, convection(0), convection(1)};
}

// Arrays of the grid begin at the point (0, 0, 0). Each loop is over all bodies before the next one begins: a point may be in the boxes of
// several.
void PhaseInertia::prepare_component(std::size_t component, const fluid::NavierStokes& fluid) {
  const Extrapolation to_next(c_);
  const double re = reynolds_number_, more = splitting_.solved_reynolds_number - reynolds_number_, c0 = c_.c0;
  std::vector<BodyPart>& bodies = components_[component].bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    find_rows(component, b);
    find_shares(component, b);
  }
  find_pieces(component);
  double* const all_force = explicit_.points()[component].data;
  double* const all_next = next_.points()[component].data;
  const Levels grid = everywhere(component, fluid);
  // What the solver has more of than the outer phase, where it has another Reynolds number.
  if (more != 0.0)
    for (const Piece& piece : components_[component].pieces)
#pragma omp simd
      for (std::ptrdiff_t at = piece.begin; at < piece.end; ++at) {
        all_next[at] = to_next.velocity(grid, at);
        all_force[at] = more * to_next.past(grid, 1.0, at);
      }
  for (const BodyPart& body : bodies)
    for (const Row& row : body.rows) {
      double *const force = all_force + row.in_grid, *const next = all_next + row.in_grid;
      const Levels whole = body.w.whole.from(row.in_box), outer = body.w.outer.from(row.in_box),
                   everywhere = grid.from(row.in_grid);
#pragma omp simd
      for (int i = 0; i < row.count; ++i) {
        next[i] = to_next.velocity(outer, i);
        force[i] =
            more * to_next.past(everywhere, 1.0, i) + re * (to_next.past(whole, 1.0, i) - to_next.past(outer, 1.0, i));
      }
    }
  for (const BodyPart& body : bodies)
    for (const Row& row : body.rows) {
      double* const next = all_next + row.in_grid;
      const double* const share = body.share.data() + row.in_shares;
      const Levels inner = body.w.inner.from(row.in_box);
      const auto [begin, end] = without_zeros(share, row.count);
#pragma omp simd
      for (int i = begin; i < end; ++i) next[i] = share[i] > 0.5 ? to_next.velocity(inner, i) : next[i];
    }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const Row& row : bodies[b].rows) {
      const double viscosity = bodies_[b].ratio, per_viscosity = 1.0 / viscosity;
      double* const force = all_force + row.in_grid;
      const double *const share = bodies[b].share.data() + row.in_shares, *const next = all_next + row.in_grid;
      const Levels outer = bodies[b].w.outer.from(row.in_box), inner = bodies[b].w.inner.from(row.in_box);
      const auto [begin, end] = without_zeros(share, row.count);
#pragma omp simd
      for (int i = begin; i < end; ++i)
        force[i] += share[i] * re *
                    ((c0 * next[i] + to_next.past(outer, 1.0, i)) -
                     per_viscosity * (c0 * next[i] + to_next.past(inner, per_viscosity, i)));
    }
  if (more != 0.0)
    for (const Piece& piece : components_[component].pieces)
#pragma omp simd
      for (std::ptrdiff_t at = piece.begin; at < piece.end; ++at) all_force[at] += more * c0 * all_next[at];
  components_[component].jumps.clear();
  for (std::size_t b = 0; b < bodies.size(); ++b) list_jumps(component, b);
}

void PhaseInertia::find_rows(std::size_t component, std::size_t body) {
  BodyPart& part = components_[component].bodies[body];
  part.rows.clear();
  const BodyPhases::Points points = phases_[body].points_of(known());
  if (!points.any()) return;
  part.w = phases_[body].levels(component, known());
  const fluid::ConstView view = std::as_const(explicit_).points()[component];
  const auto& [nx, ny, nz] = points.extent;
  reserve_with_room(part.rows, static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  const int end_of_row = grid_.periodic[0] ? grid_.cells[0] : view.extent[0];
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) {
      const int y = place_of(points.first[1] + j, 1, grid_, view.extent[1]);
      const int z = place_of(points.first[2] + k, 2, grid_, view.extent[2]);
      if (y == nowhere || z == nowhere) continue;
      for (int i = 0, count = 1; i < nx; i += count) {
        const int x = place_of(points.first[0] + i, 0, grid_, view.extent[0]);
        count = x == nowhere ? 1 : std::min(nx - i, end_of_row - x);
        if (x == nowhere) continue;
        part.rows.push_back({i + j * part.w.row_stride + k * part.w.plane_stride, i + nx * (j + std::ptrdiff_t{ny} * k),
                             offset(view, x, y, z), count});
      }
    }
}

void PhaseInertia::find_shares(std::size_t component, std::size_t body) {
  BodyPart& part = components_[component].bodies[body];
  const BodyPhases::Points points = phases_[body].points_of(known());
  const auto& [first, extent] = points;
  resize_with_room(part.share, static_cast<std::size_t>(extent[0]) * static_cast<std::size_t>(extent[1]) *
                                   static_cast<std::size_t>(extent[2]));
  std::ranges::fill(part.share, 0.0);
  const auto share_at = [&](int i, int j, int k) {
    return part.share.data() + (i - first[0]) +
           extent[0] * ((j - first[1]) + std::ptrdiff_t{extent[1]} * (k - first[2]));
  };
  const GridBand& band = bodies_[body].sharp->band(static_cast<int>(component));
  InsidePoints& inside = components_[component].inside;
  inside.find(band, grid_.spacing(0));
  for (const InsidePoints::Run& run : inside.runs()) {
    const int begin = std::max(run.first, first[0]), end = std::min(run.last, first[0] + extent[0]);
    if (begin < end && points.contains(begin, run.j, run.k))
      std::fill_n(share_at(begin, run.j, run.k), end - begin, 1.0);
  }
  // Half of it next to the membrane, whatever rounding makes of that.
  const double above_half = std::nextafter(0.5, 1.0);
  for_band(band, [&](const GridBand::Point& point) {
    const double theta = blend(bodies_[body], point.distance());
    const auto& [i, j, k] = point.index;
    if (theta > 0.0 && theta < 1.0 && points.contains(i, j, k))
      *share_at(i, j, k) = point.distance() < 0.0 ? std::max(theta, above_half) : std::min(theta, 0.5);
  });
}

// A point may be in the boxes of several bodies.
void PhaseInertia::find_pieces(std::size_t component) {
  std::vector<Piece>& pieces = components_[component].pieces;
  pieces.clear();
  const fluid::ConstView view = std::as_const(explicit_).points()[component];
  if (solves_another()) {
    pieces.push_back({0, offset(view, view.extent[0], view.extent[1] - 1, view.extent[2] - 1)});
    return;
  }
  for (const BodyPart& body : components_[component].bodies) {
    reserve_with_room(pieces, pieces.size() + body.rows.size());
    for (const Row& row : body.rows) pieces.push_back({row.in_grid, row.in_grid + row.count});
  }
  std::ranges::sort(pieces, {}, &Piece::begin);
  std::size_t count = 0;
  for (const Piece piece : pieces)
    if (count > 0 && piece.begin <= pieces[count - 1].end)
      pieces[count - 1].end = std::max(pieces[count - 1].end, piece.end);
    else
      pieces[count++] = piece;
  pieces.resize(count);
}

// The two phases of the new time, by which the grid's is not the one meant.
void PhaseInertia::list_jumps(std::size_t component, std::size_t body) {
  std::vector<JumpPart>& jumps = components_[component].jumps;
  const double ratio = bodies_[body].ratio, of_jump = c_.c0 * reynolds_number_;
  const GridBand& band = bodies_[body].sharp->band(static_cast<int>(component));
  const BodyPhases::Points points = phases_[body].points_of(known());
  const fluid::ConstView view = std::as_const(explicit_).points()[component];
  reserve_with_room(jumps, jumps.size() + band.points().size() / 4);  // one in ten is within the step
  for_band(band, [&](const GridBand::Point& point) {
    const double theta = blend(bodies_[body], point.distance());
    if (theta == 0.0 || theta == 1.0) return;
    std::array<int, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = place_of(point.index[axis], axis, grid_, view.extent[axis]);
    if (std::ranges::find(place, nowhere) != place.end()) return;
    const std::ptrdiff_t in_grid = offset(view, place[0], place[1], place[2]);
    const bool is_inside = point.distance() < 0.0;
    jumps.push_back({in_grid, &band, point.at, of_jump * (is_inside ? -(1.0 - theta) : theta / ratio)});
    if (!is_inside && points.contains(point.index[0], point.index[1], point.index[2]))
      list_shared(component, point, in_grid, of_jump * theta * (1.0 - 1.0 / ratio));
  });
}

// Such a point may be inside of another body, or of an image of its own, whose jump counts there for both.
void PhaseInertia::list_shared(std::size_t component, const GridBand::Point& point, std::ptrdiff_t in_grid,
                               double factor) {
  std::vector<JumpPart>& jumps = components_[component].jumps;
  for (const Body& body : bodies_) {
    const GridBand& band = body.sharp->band(static_cast<int>(component));
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
          reserve_with_room(jumps, jumps.size() + 1);
          jumps.push_back({in_grid, &band, at, factor});
        }
  }
}

void PhaseInertia::add_to(fluid::FaceVector& density) const {
  const auto all = density.points();
  const auto prepared = explicit_.points();
  in_shares(3, [&](Eigen::Index begin, Eigen::Index end) {
    for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
      double* const force = all[c].data;
      const double* const from = prepared[c].data;
      for (const Piece& piece : components_[c].pieces)
        std::transform(from + piece.begin, from + piece.end, force + piece.begin, force + piece.begin, std::plus<>());
      for (const JumpPart& part : components_[c].jumps) force[part.in_grid] += part.factor * part.band->jump(part.at);
    }
  });
}

void PhaseInertia::clear(fluid::FaceVector& density) const {
  const auto all = density.points();
  for (const std::size_t c : components) {
    double* const force = all[c].data;
    for (const Piece& piece : components_[c].pieces) std::fill(force + piece.begin, force + piece.end, 0.0);
    for (const JumpPart& part : components_[c].jumps) force[part.in_grid] = 0.0;
  }
}

// put(field, in_field, jump) for all places where a field of the grid holds a point inside that knows its jump.
template <class Put>
void PhaseInertia::for_jumps_inside(const Put& put) {
  const auto fields = continuation_.points();
  for (const Body& body : bodies_)
    for (const std::size_t c : components) {
      const GridBand& band = body.sharp->band(static_cast<int>(c));
      for_band(band, [&](const GridBand::Point& point) {
        if (point.distance() < 0.0)
          for_places(point.index, grid_, fields[c].extent,
                     [&](int i, int j, int k) { put(fields[c](i, j, k), band.jump(point.at)); });
      });
    }
}

void PhaseInertia::keep(const fluid::FaceVector& velocity, double dt) {
  ++now_;
  steps_[time(0)] = dt;
  for_jumps_inside([](double& w, double jump) { w += jump; });
  for (std::size_t b = 0; b < bodies_.size(); ++b) phases_[b].keep(time(0), *bodies_[b].sharp, velocity, continuation_);
  for_jumps_inside([](double& w, double) { w = 0.0; });
  keep_convection(0, velocity);
}

std::vector<fluid::FaceVector> PhaseInertia::outer_state(const fluid::NavierStokes& fluid) const {
  std::vector<fluid::FaceVector> state;
  state.push_back(fluid.velocity().clone());
  state.push_back(fluid.previous_velocity().clone());
  for (const BodyPhases& body : phases_)
    for (std::size_t back = 0; back < state.size(); ++back) body.put_outer(time(back), state[back]);
  if (!earlier_.empty() && known_times() == 3) state.push_back(earlier_[(now_ - 2) % earlier_.size()].clone());
  return state;
}

PhaseInertia::InnerState PhaseInertia::inner_state(std::size_t body) const {
  InnerState state{phases_[body].state(time(0)), phases_[body].state(time(1))};
  if (known_times() == 3) state.push_back(phases_[body].state(time(2), true));
  return state;
}

void PhaseInertia::restore(std::span<const fluid::FaceVector> outer, std::span<const InnerState> inner,
                           double earlier_step, const fluid::NavierStokes& fluid) {
  if (!(earlier_step >= 0.0 && std::isfinite(earlier_step)))
    throw std::invalid_argument(fmt::format("the state has an earlier step of {:g}, it must be >= 0", earlier_step));
  const std::size_t known = earlier_step > 0.0 && splitting_.curvature > 0.0 ? 3 : 2;
  const std::size_t on_grid = earlier_.empty() ? 2 : known;
  if (outer.size() != on_grid || inner.size() != bodies_.size())
    throw std::invalid_argument(fmt::format(
        "the state has {} velocities of the outer phase and those inside of {} vesicles, expected {} and {}",
        outer.size(), inner.size(), on_grid, bodies_.size()));
  for (const InnerState& rows : inner)
    if (rows.size() != known)
      throw std::invalid_argument(
          fmt::format("the state has the velocity inside of a vesicle at {} times, expected {}", rows.size(), known));
  for (const fluid::FaceVector& field : outer)
    if (!(field.grid() == grid_) || !all_finite(field))
      throw std::invalid_argument("the velocity of a phase is not on the grid of the fluid, or not finite");
  now_ = remembered_ = first_time;
  steps_.fill(0.0);
  steps_[time(0)] = fluid.clock().time_step;
  if (known == 3) steps_[time(1)] = earlier_step;
  const std::array<const fluid::FaceVector*, 2> velocity{&fluid.velocity(), &fluid.previous_velocity()};
  // Next to walls membranes do not reach, and ghosts there are those of the fluid.
  std::array<fluid::FaceVector, 2> continued{velocity[0]->clone(), velocity[1]->clone()};
  for (const std::size_t back : {0U, 1U})
    for (const std::size_t c : components) {
      const fluid::ConstView source = outer[back].points()[c];
      const fluid::View target = continued[back].points()[c];
      for (int k = 0; k < source.extent[2]; ++k)
        for (int j = 0; j < source.extent[1]; ++j)
          for (int i = 0; i < source.extent[0]; ++i)
            for_places({i, j, k}, grid_, target.extent,
                       [&](int x, int y, int z) { target(x, y, z) = source(i, j, k); });
    }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    std::vector<BodyPhases::Saved> saved;
    for (const std::size_t back : {0U, 1U})
      saved.push_back({time(back), inner[b][back], velocity[back], &continued[back]});
    if (known == 3) saved.push_back({time(2), inner[b][2], nullptr, nullptr});
    phases_[b].restore(saved);
  }
  for (const std::size_t back : {0U, 1U}) keep_convection(back, *velocity[back]);
  if (on_grid == 3) copy_field(outer[2], earlier_[(now_ - 2) % earlier_.size()]);
}

}  // namespace vesiflow::coupling
