// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The preconditioner of StokesSolver and its parts.
#include "stokes/velocity_multigrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "operators/block_algebra.h"
#include "operators/tensor_map.h"
#include "stokes/saddle_vector.h"
#include "test_problems.h"

namespace vesiflow::fluid::velocity_multigrid_test {
namespace {

const test::Topology topologies[] = {{}, {.periodic = 5}, {.periodic = 7}, {.mirror = 6}, {.periodic = 4, .mirror = 1}};

// Odd and unequal numbers of cells.
Grid fine_grid(const test::Topology& topology) {
  return test::with_topology(Grid({-1, 0, 0}, {1, 3, 1}, {15, 22, 9}), topology);
}

Viscosity drop(const Grid& grid, double ratio) {
  const auto value = [&](const Vector3& r) {
    const double distance = std::hypot(r[0], r[1] - 1.5, r[2] - 0.5);
    return 1.0 + 0.5 * (ratio - 1.0) * (1.0 - std::tanh((distance - 0.4) / grid.min_spacing()));
  };
  return {sample_viscosity(grid, value)};
}

void fill_random(Blocks x, unsigned seed) {
  for (const View& block : x) test::fill_random(block, seed++);
}

// Even components are constant near a mirror.
TEST(TensorMap, InterpolatesLinearFunctionsThatVanishOnWalls) {
  for (const auto& [fine_cells, coarse_cells, mirror] :
       {std::tuple{15, 8, 0}, {12, 6, 0}, {9, 9, 0}, {15, 8, 1}, {12, 6, 1}}) {
    const Grid fine = test::with_topology(Grid({0, 0, 0}, {1, 1, 1}, {fine_cells, 4, 4}), {.mirror = mirror});
    const Grid coarse = test::with_topology(Grid({0, 0, 0}, {1, 1, 1}, {coarse_cells, 4, 4}), {.mirror = mirror});
    for (const Centring centring : {Centring::face_x, Centring::face_y}) {
      const LineMap map = LineMap::interpolation(coarse, fine, centring, 0);
      const int coarse_first = first_unknown(coarse, centring, 0);
      const int fine_first = first_unknown(fine, centring, 0);
      // x near the lower wall, 1 - x near the upper: linear between any two points that are used together.
      for (const bool lower : {true, false}) {
        const auto f = [&](const Grid& grid, int i) {
          const double x = point_position(grid, centring, i, 0, 0)[0];
          if (lower && grid.mirror[0] && !is_face_normal(centring, 0)) return 1.0;
          return lower ? x : 1.0 - x;
        };
        for (int i = 0; i < map.rows(); ++i) {
          const double x = point_position(fine, centring, i + fine_first, 0, 0)[0];
          if (lower ? x > 0.5 : x < 0.5) continue;
          double sum = 0.0;
          for (const auto* e = map.begin(i); e != map.end(i); ++e)
            sum += e->weight * f(coarse, e->index + coarse_first);
          EXPECT_NEAR(sum, f(fine, i + fine_first), 1e-14);
        }
      }
    }
  }
}

TEST(TensorMap, RestrictionIsTheScaledTranspose) {
  for (const test::Topology& topology : topologies) {
    const Grid fine = fine_grid(topology);
    const Grid coarse(fine.lower, fine.upper, {8, 11, 9}, {.periodic = fine.periodic, .mirror = fine.mirror});
    SaddleVector a(fine), pb(fine);
    SaddleVector b(coarse), ra(coarse);
    fill_random(a.u(), 1);
    fill_random(b.u(), 4);
    PlaneSums sums(30);
    for (int c = 0; c < 3; ++c) {
      const Centring centring = face_centrings[c];
      const auto lines = [&](auto&& line) { return TensorMap({line(0), line(1), line(2)}); };
      lines([&](int axis) { return LineMap::interpolation(coarse, fine, centring, axis); }).apply(b.u()[c], pb.u()[c]);
      lines([&](int axis) { return LineMap::restriction(fine, coarse, centring, axis); }).apply(a.u()[c], ra.u()[c]);
      const double left = sums.dot(View(a.u()[c]), View(pb.u()[c])) * fine.cell_volume();
      const double right = sums.dot(View(ra.u()[c]), View(b.u()[c])) * coarse.cell_volume();
      EXPECT_NEAR(left, right, 1e-14);
    }
  }
}

TEST(TensorMap, CellAveragesKeepTheIntegral) {
  const Grid fine({0, 0, 0}, {1, 1, 1}, {15, 4, 4});
  const Grid coarse({0, 0, 0}, {1, 1, 1}, {8, 4, 4});
  const LineMap map = LineMap::cell_average(fine, coarse, 0);
  std::vector<double> column(15, 0.0);
  for (int i = 0; i < map.rows(); ++i) {
    double row = 0.0;
    for (const auto* e = map.begin(i); e != map.end(i); ++e) {
      row += e->weight;
      column[e->index] += e->weight;
    }
    EXPECT_NEAR(row, 1.0, 1e-14);
  }
  for (const double sum : column) EXPECT_NEAR(sum, 8.0 / 15.0, 1e-14);
}

// Applied to one unit vector after the other.
TEST(Stencil, DiagonalOfTheStress) {
  for (const test::Topology& topology : topologies) {
    const Grid grid = test::with_topology(Grid({-1, 0, 0}, {1, 3, 1}, {5, 4, 6}), topology);
    const Viscosity mu = drop(grid, 7.0);
    const EllipticProblem problem = EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, mu);
    const Stencil stencil(problem);
    for (int c = 0; c < 3; ++c) {
      const auto n = problem.extent(c);
      const Centring centring = face_centrings[c];
      GhostedBlocks unit(problem), product(problem);
      std::vector<double> row(static_cast<std::size_t>(grid.cells[0]) + 2);
      test::for_each_point(n, [&](int i, int j, int k) {
        unit.unknowns()[c](i, j, k) = 1.0;
        stencil.apply(unit, product.unknowns());
        unit.unknowns()[c](i, j, k) = 0.0;
        stress_diagonal_row(grid, mu.field().points(), c, j + first_unknown(grid, centring, 1),
                            k + first_unknown(grid, centring, 2), row.data());
        const double expected = product.unknowns()[c](i, j, k);
        EXPECT_NEAR(row[i + first_unknown(grid, centring, 0)], expected, 1e-13 * expected);
      });
    }
  }
}

TEST(VelocityMultigrid, IsSymmetricAndPositive) {
  for (const test::Topology& topology : topologies) {
    const Grid grid = fine_grid(topology);
    VelocityMultigrid multigrid(grid);
    multigrid.update(drop(grid, 30.0));
    PlaneSums sums(30);
    SaddleVector a(grid), b(grid), ma(grid), mb(grid);
    fill_random(a.u(), 1);
    fill_random(b.u(), 4);
    if (!grid.has_walls()) {
      sums.remove_means(a.u());
      sums.remove_means(b.u());
    }
    multigrid.apply(a.u(), ma.u());
    multigrid.apply(b.u(), mb.u());
    const double ab = sums.dot(a.u(), mb.u());
    const double aa = sums.dot(a.u(), ma.u());
    const double bb = sums.dot(b.u(), mb.u());
    EXPECT_GT(aa, 0.0);
    EXPECT_GT(bb, 0.0);
    EXPECT_NEAR(ab, sums.dot(b.u(), ma.u()), 1e-13 * std::sqrt(aa * bb));
  }
}

// The error of b = A x after a number of cycles, in the energy norm that A makes, shrinks by about 0.7 in each whatever the
// grid and the viscosities.
TEST(VelocityMultigrid, CyclesConverge) {
  for (const test::Topology& topology : topologies) {
    for (const int cells : {12, 24}) {
      const Grid grid = test::with_topology(Grid({-1, 0.5, -0.5}, {1, 2.5, 1.5}, {cells, cells + 1, cells}), topology);
      for (const double ratio : {0.05, 1.0, 100.0}) {
        const Viscosity mu = drop(grid, ratio);
        VelocityMultigrid multigrid(grid);
        multigrid.update(mu);
        SaddleVector error(grid), residual(grid), correction(grid);
        fill_random(error.u(), 9);
        PlaneSums sums(30);
        const auto energy = [&] {
          if (!grid.has_walls()) sums.remove_means(error.u());
          multigrid.viscous_operator().apply(error.velocity, residual.u());
          return std::sqrt(sums.dot(error.u(), residual.u()));
        };
        const double first = energy();
        constexpr int cycles = 8;
        for (int cycle = 0; cycle < cycles; ++cycle) {
          energy();
          multigrid.apply(residual.u(), correction.u());
          add(-1.0, correction.u(), error.u());
        }
        EXPECT_LT(std::pow(energy() / first, 1.0 / cycles), 0.7)
            << cells << " cells, ratio " << ratio << ", " << topology;
      }
    }
  }
}

}  // namespace
}  // namespace vesiflow::fluid::velocity_multigrid_test
