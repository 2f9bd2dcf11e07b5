// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "transfer/grid_band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/allocation_counter.h"
#include "transfer/ellipsoid.h"
#include "vesicle/point_evaluation.h"

namespace vesiflow::coupling::grid_band_test {
namespace {

using fluid::Centring;
using test::Ellipsoid;
using Vector = Eigen::Vector3d;

constexpr Centring all_centrings[] = {Centring::face_x, Centring::face_y, Centring::face_z, Centring::cell};

const fluid::Grid box({-2, -2.2, -2}, {2, 2.2, 2}, {20, 24, 22}, {.periodic = {true, true, true}});
constexpr double spacing = 0.18;  // of nodes: 0.9 times the smallest of the grid's

vesicle::Surface surface_of(const Ellipsoid& body) {
  vesicle::Surface surface(32);
  surface.update(body.markers(surface.grid()));
  return surface;
}

FineSurface fine_surface_of(const Ellipsoid& body, int records = 1) {
  FineSurface fine(records);
  fine.update(surface_of(body), spacing);
  return fine;
}

Vector position(const fluid::Grid& grid, Centring centring, int i, int j, int k) {
  const fluid::Vector3 x = fluid::point_position(grid, centring, i, j, k);
  return {x[0], x[1], x[2]};
}

/// Compares each point of the grid, and its images in the boxes around, with the exact distance; returns the largest error.
/// Points are missed or too many only where the exact distance is that of the width to 1e-5.
double compare(const GridBand& band, const fluid::Grid& grid, Centring centring, const Ellipsoid& body, double width) {
  double error = 0.0;
  std::size_t found = 0;
  const auto& n = grid.cells;
  for (int k = -n[2]; k < 2 * n[2]; ++k)
    for (int j = -n[1]; j < 2 * n[1]; ++j)
      for (int i = -n[0]; i < 2 * n[0]; ++i) {
        const double exact = body.closest(position(grid, centring, i, j, k)).distance;
        const bool is_there = band.contains(i, j, k) && band.distance(band.offset(i, j, k)) != GridBand::far;
        found += is_there ? 1 : 0;
        if (std::abs(exact) < width - 1e-5) {
          EXPECT_TRUE(is_there) << i << ' ' << j << ' ' << k << ' ' << exact;
        }
        if (!is_there) continue;
        const std::ptrdiff_t at = band.offset(i, j, k);
        EXPECT_LT(std::abs(exact), width + 1e-5);
        EXPECT_EQ(band.is_inside(at), exact < 0.0) << exact;
        error = std::max(error, std::abs(band.distance(at) - exact));
      }
  EXPECT_EQ(found, band.count());
  return error;
}

double largest_error(const Ellipsoid& body, double width) {
  const FineSurface fine = fine_surface_of(body);
  double error = 0.0;
  for (const Centring centring : all_centrings) {
    GridBand band(box, centring);
    band.update(fine, width);
    error = std::max(error, compare(band, box, centring, body, width));
  }
  return error;
}

TEST(GridBand, KnowsTheDistanceFromASphere) {
  const double e = largest_error({{1, 1, 1}, {0.1, -0.2, 0.05}}, 0.7);
  EXPECT_LT(e, 5e-4 * spacing);  // far below the error of what is continued over it, of third order in the spacing
}

TEST(GridBand, KnowsTheDistanceFromAnEllipsoid) {
  const double e = largest_error({{0.8, 1.0, 1.3}, {0.1, -0.2, 0.05}}, 0.45);
  EXPECT_LT(e, 5e-4 * spacing);  // far below the error of what is continued over it, of third order in the spacing
}

// Wider than the least radius of curvature, 0.28 at the tips, so that closest points are not unique; next to the mean plane of
// the body, where they change sides, and at a disc.
TEST(GridBand, KnowsTheDistanceFromSlimBodies) {
  const Ellipsoid needle({0.72, 0.72, 1.85}, {0.1, -0.2, 0.05}), disc({0.5, 1.4, 1.5}, {0.1, -0.2, 0.05});
  ASSERT_LT(needle.least_radius(), 0.3);
  ASSERT_LT(disc.least_radius(), 0.2);
  double e = largest_error(needle, 0.7);
  EXPECT_LT(e, 4e-3 * spacing);  // where the radius of curvature is about a spacing
  e = largest_error(disc, 0.7);
  EXPECT_LT(e, 4e-3 * spacing);  // where the radius of curvature is about a spacing
}

// Across ends, an edge and a corner of the box, and some boxes off: indices run on.
TEST(GridBand, ABodyMayLieAcrossPeriodicEnds) {
  const Vector middle(0.1, -0.2, 0.05), axes(0.8, 1.0, 1.3);
  const FineSurface fine = fine_surface_of({axes, middle});
  struct Shift {
    int i, j, k;
  };
  for (const Shift& shift : {Shift{10, 0, 0}, Shift{-9, 12, 0}, Shift{10, -12, 11}, Shift{47, 3, -50}}) {
    const Vector moved = middle + Vector(shift.i * box.spacing(0), shift.j * box.spacing(1), shift.k * box.spacing(2));
    const FineSurface fine_moved = fine_surface_of({axes, moved});
    for (const Centring centring : all_centrings) {
      GridBand here(box, centring), there(box, centring);
      here.update(fine, 0.45);
      there.update(fine_moved, 0.45);
      EXPECT_EQ(here.count(), there.count());
      const auto& first = here.first();
      for (int k = first[2]; k < first[2] + here.extent()[2]; ++k)
        for (int j = first[1]; j < first[1] + here.extent()[1]; ++j)
          for (int i = first[0]; i < first[0] + here.extent()[0]; ++i) {
            const double d = here.distance(here.offset(i, j, k));
            if (d == GridBand::far) continue;
            ASSERT_TRUE(there.contains(i + shift.i, j + shift.j, k + shift.k));
            // Points midway between two nodes may start from the other one.
            EXPECT_NEAR(there.distance(there.offset(i + shift.i, j + shift.j, k + shift.k)), d, 1e-6);
          }
    }
  }
}

// As a body moves through the grid the number of points changes a little.
TEST(GridBand, AllocatesNothingWhereABodyMoves) {
  if (!vesiflow::test::allocations_are_counted()) GTEST_SKIP() << "malloc cannot be counted here";
  GridBand band(box, Centring::face_y);
  FineSurface fine(1);
  std::vector<vesicle::Surface> path;
  for (int step = 0; step < 12; ++step)
    path.push_back(surface_of({{0.8, 1.0, 1.3}, {0.1 + 0.03 * step, -0.2 - 0.02 * step, 0.05 + 0.01 * step}}));
  fine.update(path[0], spacing);
  band.update(fine, 0.45);
  const long before = vesiflow::test::allocation_count();
  for (const vesicle::Surface& surface : path) {
    fine.update(surface, spacing);
    band.update(fine, 0.45);
    band.evaluate(fine, FineSurface::jumps);
  }
  EXPECT_EQ(vesiflow::test::allocation_count() - before, 0);
}

}  // namespace
}  // namespace vesiflow::coupling::grid_band_test
