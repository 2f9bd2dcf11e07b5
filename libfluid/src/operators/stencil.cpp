// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "operators/stencil.h"

#include <algorithm>
#include <utility>

#include "grid/planes.h"
#include "operators/convection_row.h"

namespace vesiflow::fluid {
namespace {

// Means of the coefficient midway from a point to its upper neighbour along an axis: of the four cells that meet at an
// edge; of the two on either side of a face or the one whose centre this is, taken twice or four times.
struct MeanCoefficient {
  MeanCoefficient(ConstView mu, Centring centring, int axis, int j, int k) {
    const double* here = mu.row(j, k);
    const std::ptrdiff_t up = stride(mu, axis);
    below_step = up;
    if (is_face_normal(centring, axis)) {
      cell = {here, here, here, here};
    } else if (centring == Centring::cell) {
      cell = {here, here, here + up, here + up};
    } else {
      const std::ptrdiff_t back = stride(mu, static_cast<int>(centring) - 1);
      cell = {here, here - back, here + up, here + up - back};
    }
  }
  double above(int i) const { return 0.25 * (cell[0][i] + cell[1][i] + cell[2][i] + cell[3][i]); }
  double below(std::ptrdiff_t i) const {
    i -= below_step;
    return 0.25 * (cell[0][i] + cell[1][i] + cell[2][i] + cell[3][i]);
  }

  std::array<const double*, 4> cell;
  std::ptrdiff_t below_step;
};

// Of the blocks whose points are half a cell away from the end: all of them have the same condition there.
double reflection(const EllipticProblem& problem, int axis, int side) {
  const int block = is_face_normal(problem.centring(0), axis) ? problem.blocks() - 1 : 0;
  return problem.condition(block, axis, side) == BoundaryCondition::dirichlet ? -1.0 : 1.0;
}

void constant_laplacian_row(const EllipticProblem& problem, int block, ConstView x, int j, int k, double* out) {
  const double* here = x.row(j, k);
  const double* south = here - x.row_stride;
  const double* north = here + x.row_stride;
  const double* below = here - x.plane_stride;
  const double* above = here + x.plane_stride;
  std::array<double, 3> scale{};
  for (int axis = 0; axis < 3; ++axis) {
    const double h = problem.grid.spacing(axis);
    scale[axis] = problem.mu.value() / (h * h);
  }
  const double sx = scale[0], sy = scale[1], sz = scale[2];
  const double diagonal = problem.alpha + 2.0 * (sx + sy + sz);
  const int begin = first_unknown(problem.grid, problem.centring(block), 0);
  const int end = begin + problem.extent(block)[0];
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    out[i] =
        diagonal * here[i] - sx * (here[i - 1] + here[i + 1]) - sy * (south[i] + north[i]) - sz * (below[i] + above[i]);
  }
}

}  // namespace

GhostedBlocks::GhostedBlocks(const EllipticProblem& problem)
    : count_(problem.blocks()), periodic_(problem.grid.periodic) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) reflection_[axis][side] = reflection(problem, axis, side);
  }
  for (int block = 0; block < count_; ++block) {
    centring_[block] = problem.centring(block);
    const auto n = point_extent(problem.grid, centring_[block]);
    const std::ptrdiff_t row = n[0] + 2;
    const std::ptrdiff_t plane = row * (n[1] + 2);
    storage_[block] = allocate_aligned(static_cast<std::size_t>(plane * (n[2] + 2)));
    View& points = points_[block];
    points = {storage_[block].get() + plane + row + 1, n, row, plane};
    View& unknowns = unknowns_[block];
    unknowns = points;
    unknowns.extent = problem.extent(block);
    for (int axis = 0; axis < 3; ++axis) {
      unknowns.data += first_unknown(problem.grid, centring_[block], axis) * stride(points, axis);
    }
  }
}

void GhostedBlocks::assign(ConstBlocks x) {
  for (int block = 0; block < count_; ++block) {
    const View to = unknowns_[block];
    for_each_plane(to.extent, [&](int k) {
      for (int j = 0; j < to.extent[1]; ++j) std::copy_n(x[block].row(j, k), to.extent[0], to.row(j, k));
    });
  }
}

// Axis by axis, each time over the ghosts of the axes before.
void GhostedBlocks::set_ghosts() {
  for (int block = 0; block < count_; ++block) {
    const View& x = points_[block];
    for (int axis = 0; axis < 3; ++axis) {
      const int a = axis == 0 ? 1 : 0;
      const int b = axis == 2 ? 1 : 2;
      const int from_a = a < axis ? -1 : 0;
      const int from_b = b < axis ? -1 : 0;
      const std::ptrdiff_t step = stride(x, axis);
      const int last = x.extent[axis] - 1;
      const bool normal = is_face_normal(centring_[block], axis);
      for (int q = from_b; q < x.extent[b] - from_b; ++q) {
        for (int p = from_a; p < x.extent[a] - from_a; ++p) {
          double* line = x.data + p * stride(x, a) + q * stride(x, b);
          if (periodic_[axis]) {
            if (normal) line[last * step] = line[0];
            line[-step] = line[(normal ? last - 1 : last) * step];
            line[(last + 1) * step] = line[normal ? step : 0];
          } else if (normal) {
            line[0] = 0.0;
            line[last * step] = 0.0;
            line[-step] = -line[step];
            line[(last + 1) * step] = -line[(last - 1) * step];
          } else {
            line[-step] = reflection_[axis][0] * line[0];
            line[(last + 1) * step] = reflection_[axis][1] * line[last * step];
          }
        }
      }
    }
  }
}

void CoefficientView::set(const Grid& grid, const Viscosity& mu) {
  if (mu.is_constant()) {
    row_.assign(static_cast<std::size_t>(grid.cells[0]) + 2, mu.value());
    view_ = {row_.data() + 1, grid.cells, 0, 0};
  } else {
    view_ = mu.field().points();
  }
}

Stencil::Stencil(const EllipticProblem& problem) : problem_(problem), mu_(problem.grid, problem.mu) {}

void Stencil::update(const EllipticProblem& problem) {
  problem_ = problem;
  mu_.set(problem.grid, problem.mu);
}

void Stencil::apply(GhostedBlocks& x, Blocks y) const {
  x.set_ghosts();
  apply_to_points(std::as_const(x).points(), y);
}

void Stencil::apply_to_points(ConstBlocks points, Blocks y) const {
  const Grid& grid = problem_.grid;
  for (int block = 0; block < problem_.blocks(); ++block) {
    const auto n = problem_.extent(block);
    const Centring centring = problem_.centring(block);
    const std::array<int, 3> first{first_unknown(grid, centring, 0), first_unknown(grid, centring, 1),
                                   first_unknown(grid, centring, 2)};
    for_each_plane(n, [&](int k) {
      for (int j = 0; j < n[1]; ++j) {
        apply_row(points, block, j + first[1], k + first[2], y[block].row(j, k) - first[0]);
      }
    });
  }
}

void Stencil::apply_row(ConstBlocks points, int block, int j, int k, double* out) const {
  const Grid& grid = problem_.grid;
  const ConstView& x = points[block];
  if (problem_.form == EllipticForm::laplacian && problem_.mu.is_constant()) {
    constant_laplacian_row(problem_, block, x, j, k, out);
    return;
  }
  const double* here = x.row(j, k);
  const int begin = first_unknown(grid, problem_.centring(block), 0);
  const int end = begin + problem_.extent(block)[0];
#pragma omp simd
  for (int i = begin; i < end; ++i) out[i] = problem_.alpha * here[i];
  if (problem_.form == EllipticForm::stress) {
    add_stress_row(grid, {points[0], points[1], points[2]}, mu_, 0.0, -1.0, block, j, k, out);
  } else {
    add_variable_laplacian_row(grid, problem_.centring(block), x, mu_, -1.0, j, k, out);
  }
}

void add_variable_laplacian_row(const Grid& grid, Centring centring, ConstView x, ConstView mu, double factor, int j,
                                int k, double* out) {
  const double* here = x.row(j, k);
  const std::array<MeanCoefficient, 3> m{MeanCoefficient(mu, centring, 0, j, k), MeanCoefficient(mu, centring, 1, j, k),
                                         MeanCoefficient(mu, centring, 2, j, k)};
  const std::array<double, 3> scale{factor / (grid.spacing(0) * grid.spacing(0)),
                                    factor / (grid.spacing(1) * grid.spacing(1)),
                                    factor / (grid.spacing(2) * grid.spacing(2))};
  const std::ptrdiff_t sy = x.row_stride;
  const std::ptrdiff_t sz = x.plane_stride;
  const auto flux_difference = [&](const MeanCoefficient& mean, std::ptrdiff_t step, int i) {
    return mean.above(i) * (here[i + step] - here[i]) - mean.below(i) * (here[i] - here[i - step]);
  };
  const int begin = first_unknown(grid, centring, 0);
  const int end = begin + unknown_extent(grid, centring)[0];
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    out[i] += scale[0] * flux_difference(m[0], 1, i) + scale[1] * flux_difference(m[1], sy, i) +
              scale[2] * flux_difference(m[2], sz, i);
  }
}

void add_stress_row(const Grid& grid, const std::array<ConstView, 3>& u, ConstView mu, double offset, double factor,
                    int component, int j, int k, double* out) {
  // Along an axis d other than the component c, at the edge above: d u_c / d d from c's own neighbours, and
  // d u_d / d c from the two faces normal to d that meet the edge.
  struct Axis {
    MeanCoefficient mean;
    const double* u_c;
    std::ptrdiff_t c_step;
    const double *u_d, *u_d_back;
    std::ptrdiff_t d_step;
    double per_h;
  };
  const Centring centring = face_centrings[component];
  const auto axis = [&](int d) {
    const std::ptrdiff_t d_step = stride(u[d], d);
    const double* u_d = u[d].row(j, k) + d_step;
    return Axis{MeanCoefficient(mu, centring, d, j, k),
                u[component].row(j, k),
                stride(u[component], d),
                u_d,
                u_d - stride(u[d], component),
                d_step,
                1.0 / grid.spacing(d)};
  };
  const int d1 = (component + 1) % 3;
  const int d2 = (component + 2) % 3;
  const Axis along = axis(component);
  const Axis first = axis(d1);
  const Axis second = axis(d2);
  const double per_h = along.per_h;
  const auto normal_force = [&](int i) {
    const double* c = along.u_c + i;
    const double above = (along.mean.above(i) - offset) * (c[along.c_step] - c[0]);
    const double below = (along.mean.below(i) - offset) * (c[0] - c[-along.c_step]);
    return 2.0 * per_h * per_h * (above - below);
  };
  const auto shear_force = [&](const Axis& a, int i) {
    const double* c = a.u_c + i;
    const double shear_above = (c[a.c_step] - c[0]) * a.per_h + (a.u_d[i] - a.u_d_back[i]) * per_h;
    const double shear_below =
        (c[0] - c[-a.c_step]) * a.per_h + (a.u_d[i - a.d_step] - a.u_d_back[i - a.d_step]) * per_h;
    return a.per_h * ((a.mean.above(i) - offset) * shear_above - (a.mean.below(i) - offset) * shear_below);
  };
  const int begin = first_unknown(grid, centring, 0);
  const int end = begin + unknown_extent(grid, centring)[0];
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    out[i] += factor * (normal_force(i) + shear_force(first, i) + shear_force(second, i));
  }
}

void add_stress(const FaceVector& u, ConstView mu, double offset, FaceVector& f) {
  const Grid& grid = u.grid();
  const auto velocity = u.points();
  const auto forces = f.points();
  for_each_plane(grid.cells, [&](int k) {
    for (int component = 0; component < 3; ++component) {
      const UnknownRange range = unknown_range(grid, component);
      for (int j = range.begin[1]; j < range.end[1]; ++j) {
        if (!range.contains_row(j, k)) continue;
        add_stress_row(grid, velocity, mu, offset, 1.0, component, j, k, forces[component].row(j, k));
      }
    }
  });
}

// Beyond a wall half a cell away the ghost is minus the value here, so that the edge on the wall counts twice; beyond a
// mirror it is the value here, and the edge does not count.
void stress_diagonal_row(const Grid& grid, ConstView mu, int component, int j, int k, double* out) {
  const Centring centring = face_centrings[component];
  const auto n = point_extent(grid, centring);
  const int begin = first_unknown(grid, centring, 0);
  const int end = begin + unknown_extent(grid, centring)[0];
  std::fill(out + begin, out + end, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const MeanCoefficient mean(mu, centring, axis, j, k);
    const double h = grid.spacing(axis);
    const double scale = (axis == component ? 2.0 : 1.0) / (h * h);
    const bool has_ends = axis != component && !grid.periodic[axis];
    const double at_lower_end = grid.mirror[axis] ? 0.0 : 2.0;
    for (int i = begin; i < end; ++i) {
      const int index = axis == 0 ? i : axis == 1 ? j : k;
      const double above = has_ends && index == n[axis] - 1 ? 2.0 : 1.0;
      const double below = has_ends && index == 0 ? at_lower_end : 1.0;
      out[i] += scale * (above * mean.above(i) + below * mean.below(i));
    }
  }
}

}  // namespace vesiflow::fluid
