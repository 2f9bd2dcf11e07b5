// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/indicator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fluid/operators.h"
#include "short_waits.h"

namespace vesiflow::coupling {
namespace {

// The two faces at the ends of a periodic axis are the same one. Markers write to the first; a divergence reads both.
void repeat_last_faces(fluid::FaceVector& g) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!g.grid().periodic[axis]) continue;
    const fluid::View component = g.points()[axis];
    const int last = component.extent[axis] - 1;
    std::array<int, 3> extent = component.extent;
    extent[axis] = 1;
    for (int k = 0; k < extent[2]; ++k)
      for (int j = 0; j < extent[1]; ++j)
        for (int i = 0; i < extent[0]; ++i)
          component(axis == 0 ? last : i, axis == 1 ? last : j, axis == 2 ? last : k) = component(i, j, k);
  }
}

}  // namespace

Indicator::Indicator(const fluid::Grid& grid, std::size_t membranes, DeltaKernel kernel)
    : kernel_(kernel),
      membranes_(membranes),
      jump_(grid),
      solver_(fluid::make_elliptic_solver({grid, fluid::Centring::cell, fluid::BoundaryCondition::neumann, 0.0, 1.0},
                                          fluid::FftOptions{})) {}

void Indicator::add(std::size_t membrane, const vesicle::Surface& surface, double value) {
  if (value == 0.0) return;
  Membrane& m = membranes_.at(membrane);
  if (!m.transfer) {
    const std::array<bool, 3> across = mirrors_crossed(jump_.grid(), surface.positions());
    m.transfer.emplace(jump_.grid(), kernel_, across);
    m.share = std::pow(0.5, std::ranges::count(across, true));
  }
  m.weight = value * surface.area_weight();
  m.transfer->update(surface.positions());
  m.transfer->spread(surface.normal(), m.weight, jump_);
  m.added = true;
  content_ += m.share * value * surface.volume();
}

void Indicator::solve(fluid::Field<fluid::Cell>& field) {
  if (!(field.grid() == jump_.grid())) throw std::invalid_argument("indicator: the field is on another grid");
  repeat_last_faces(jump_);
  fluid::divergence(jump_, field);
  solver_->solve(std::as_const(field).unknowns(), field.unknowns());
  const fluid::Grid& grid = field.grid();
  const double mean = content_ / (grid.length(0) * grid.length(1) * grid.length(2));
  clear();
  keep_waits_short();
#pragma omp parallel for schedule(static)
  for (int k = 0; k < field.extent(2); ++k) {
    for (int j = 0; j < field.extent(1); ++j) {
      double* row = field.row(j, k);
      for (int i = 0; i < field.extent(0); ++i) row[i] += mean;
    }
  }
}

void Indicator::clear() {
  for (Membrane& m : membranes_) {
    if (m.added) m.transfer->clear(jump_);
    m.added = false;
  }
  content_ = 0.0;
}

}  // namespace vesiflow::coupling
