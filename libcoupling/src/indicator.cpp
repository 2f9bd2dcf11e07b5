#include "coupling/indicator.h"

#include <array>
#include <utility>

#include "fluid/operators.h"

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

Indicator::Indicator(const fluid::Grid& grid, std::size_t membranes)
    : jump_(grid),
      solver_(fluid::make_elliptic_solver({grid, fluid::Centring::cell, fluid::BoundaryCondition::neumann, 0.0, 1.0},
                                          fluid::FftOptions{})) {
  membranes_.reserve(membranes);
  for (std::size_t i = 0; i < membranes; ++i) membranes_.push_back({MarkerTransfer(grid), {}, false});
}

void Indicator::add(std::size_t membrane, const vesicle::Surface& surface, double value) {
  if (value == 0.0) return;
  Membrane& m = membranes_.at(membrane);
  m.weight = value * surface.area_weight();
  m.transfer.update(surface.positions());
  m.transfer.spread(surface.normal(), m.weight, jump_);
  m.added = true;
  content_ += value * surface.volume();
}

void Indicator::solve(fluid::Field<fluid::Cell>& field) {
  repeat_last_faces(jump_);
  fluid::divergence(jump_, field);
  solver_->solve(std::as_const(field).unknowns(), field.unknowns());
  const fluid::Grid& grid = field.grid();
  const double mean = content_ / (grid.length(0) * grid.length(1) * grid.length(2));
  clear();
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
    if (m.added) m.transfer.clear(jump_);
    m.added = false;
  }
  content_ = 0.0;
}

}  // namespace vesiflow::coupling
