// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/indicator.h"
#include "fluid/operators.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::test {

/// An ellipsoid with axes along x, y and z, for which inside and outside are known; a sphere if they are equal.
struct SolidEllipsoid {
  std::array<double, 3> semi_axes{1.0, 1.0, 1.0};
  std::array<double, 3> centre{0.0, 0.0, 0.0};

  double volume() const { return 4.0 / 3.0 * M_PI * semi_axes[0] * semi_axes[1] * semi_axes[2]; }
  bool contains(const fluid::Vector3& x) const { return level(x) < 1.0; }
  /// Distance from the surface to first order, < 0 inside.
  double distance(const fluid::Vector3& x) const {
    double slope = 0.0;
    for (std::size_t a = 0; a < 3; ++a) slope += std::pow((x[a] - centre[a]) / (semi_axes[a] * semi_axes[a]), 2);
    return (level(x) - 1.0) * std::sqrt(level(x)) / std::max(std::sqrt(slope), 1e-300);
  }
  vesicle::Surface surface(int latitudes) const {
    vesicle::Surface result(latitudes);
    const double radius = std::cbrt(semi_axes[0] * semi_axes[1] * semi_axes[2]);
    vesicle::Placement placement;
    placement.effective_radius = radius;
    placement.centre = {centre[0], centre[1], centre[2]};
    result.update(vesicle::ellipsoid(result.grid(), {semi_axes[0], semi_axes[1], semi_axes[2]}, placement));
    return result;
  }

 private:
  double level(const fluid::Vector3& x) const {
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) sum += std::pow((x[a] - centre[a]) / semi_axes[a], 2);
    return std::sqrt(sum);
  }
};

struct IndicatorErrors {
  double far = 0.0;             ///< largest |I - exact| further than `away` from the surface
  double above = 0.0;           ///< max I - 1
  double below = 0.0;           ///< -min I
  double mean = 0.0;            ///< integral of |I - exact| per area
  double volume = 0.0;          ///< integral of I over the volume, less 1
  double limited_volume = 0.0;  ///< the same of I limited to [0, 1]
};

inline IndicatorErrors indicator_errors(const fluid::Field<fluid::Cell>& field, const SolidEllipsoid& shape,
                                        double area, double away) {
  IndicatorErrors e;
  double sum = 0.0, limited = 0.0;
  const double cell = field.grid().cell_volume();
  for (int k = 0; k < field.extent(2); ++k)
    for (int j = 0; j < field.extent(1); ++j)
      for (int i = 0; i < field.extent(0); ++i) {
        const fluid::Vector3 x = field.position(i, j, k);
        const double value = field(i, j, k), error = std::abs(value - (shape.contains(x) ? 1.0 : 0.0));
        if (std::abs(shape.distance(x)) > away) e.far = std::max(e.far, error);
        e.above = std::max(e.above, value - 1.0);
        e.below = std::max(e.below, -value);
        e.mean += error * cell / area;
        sum += value * cell;
        limited += std::clamp(value, 0.0, 1.0) * cell;
      }
  e.volume = sum / shape.volume() - 1.0;
  e.limited_volume = limited / shape.volume() - 1.0;
  return e;
}

/// The indicator with zero Dirichlet conditions half a cell off the walls, the other choice of the paper.
inline void dirichlet_indicator(const vesicle::Surface& surface, fluid::Field<fluid::Cell>& field) {
  const fluid::Grid& grid = field.grid();
  fluid::FaceVector jump(grid);
  MarkerTransfer transfer(grid);
  transfer.update(surface.positions());
  transfer.spread(surface.normal(), surface.area_weight(), jump);
  fluid::divergence(jump, field);
  const auto solver = fluid::make_elliptic_solver(
      {grid, fluid::Centring::cell, fluid::BoundaryCondition::dirichlet, 0.0, 1.0}, fluid::FftOptions{});
  solver->solve(std::as_const(field).unknowns(), field.unknowns());
}

}  // namespace vesiflow::coupling::test
