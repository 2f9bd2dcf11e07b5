// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viscosity/inside_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "fluid/field.h"
#include "transfer/fine_surface.h"
#include "transfer/grid_band.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling::inside_points_test {
namespace {

using Vector = Eigen::Vector3d;

/// A star-shaped body r(s) s, s a unit vector, moved to a centre: exact in harmonics as r is a polynomial of s.
struct Body {
  std::function<double(const Vector&)> radius;
  Vector centre;

  /// Above 0 outside; about a distance near the surface.
  double level(const Vector& x) const {
    const Vector r = x - centre;
    return r.norm() - radius(r.normalized());
  }

  vesicle::Surface surface() const {
    vesicle::Surface result(32);
    const vesicle::SphereGrid& grid = result.grid();
    vesicle::VectorField x(grid.size(), 3);
    for (int j = 0; j < grid.latitudes(); ++j)
      for (int i = 0; i < grid.longitudes(); ++i) {
        const double theta = grid.colatitude()[j], phi = grid.longitude(i);
        const Vector s(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
        x.row(grid.index(i, j)) = (centre + radius(s) * s).transpose();
      }
    result.update(x);
    return result;
  }
};

/// Lines along x meet it up to four times: it is longest along x and has a waist there.
double peanut(const Vector& s) {
  return 1.0 + 0.6 * (1.5 * s.x() * s.x() - 0.5);
}

GridBand band_of(const Body& body, const fluid::Grid& grid, fluid::Centring centring, double width) {
  FineSurface fine(0);
  fine.update(body.surface(), 0.9 * grid.min_spacing());
  GridBand band(grid, centring);
  band.update(fine, width);
  return band;
}

constexpr std::array all_centrings{fluid::Centring::cell, fluid::Centring::face_x, fluid::Centring::face_y,
                                   fluid::Centring::face_z};

// Points nearer to the membrane than that may be on either side by the interpolation of the surface: there are none here.
constexpr double doubtful = 1e-5;

TEST(InsidePoints, AreThosePointsThatTheMembraneEncloses) {
  const fluid::Grid grid({-2.1, -1.9, -2.0}, {2.3, 2.0, 2.1}, {40, 24, 30});  // spacings that differ by a half
  const Body body{peanut, Vector(0.113, 0.047, -0.071)};
  for (const fluid::Centring centring : all_centrings) {
    InsidePoints inside;
    inside.find(band_of(body, grid, centring, grid.spacing(1) * 1.5), grid.spacing(0));
    std::set<std::array<int, 3>> found;
    int lines_met_twice = 0;
    const InsidePoints::Run* last = nullptr;
    for (const InsidePoints::Run& run : inside.runs()) {
      EXPECT_LT(run.first, run.last);
      if (last != nullptr && last->j == run.j && last->k == run.k) ++lines_met_twice;
      last = &run;
      for (int i = run.first; i < run.last; ++i) EXPECT_TRUE(found.insert({i, run.j, run.k}).second);
    }
    EXPECT_GT(lines_met_twice, 10) << "the waist";
    const auto n = fluid::point_extent(grid, centring);
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const fluid::Vector3 x = fluid::point_position(grid, centring, i, j, k);
          const double level = body.level({x[0], x[1], x[2]});
          ASSERT_GT(std::abs(level), doubtful);
          EXPECT_EQ(found.contains({i, j, k}), level < 0.0)
              << fluid::name(centring) << " " << i << " " << j << " " << k << ", level " << level;
        }
  }
}

// A wide band says the same: what is known of a point far from the membrane is not needed.
TEST(InsidePoints, DoNotDependOnTheWidthOfTheBand) {
  const fluid::Grid grid({-2, -2, -2}, {2, 2, 2}, {32, 32, 32});
  const Body body{peanut, Vector(0.013, 0.047, -0.071)};
  InsidePoints narrow, wide;
  narrow.find(band_of(body, grid, fluid::Centring::face_y, 1.01 * grid.spacing(0)), grid.spacing(0));
  wide.find(band_of(body, grid, fluid::Centring::face_y, 3.5 * grid.spacing(0)), grid.spacing(0));
  ASSERT_EQ(narrow.runs().size(), wide.runs().size());
  for (std::size_t r = 0; r < narrow.runs().size(); ++r) {
    EXPECT_EQ(narrow.runs()[r].first, wide.runs()[r].first);
    EXPECT_EQ(narrow.runs()[r].last, wide.runs()[r].last);
  }
}

// Across the ends of a periodic box, seen from several periods off, in points, repeated faces and ghosts.
TEST(InsidePoints, AreMultipliedInEveryPlaceOfAPeriodicField) {
  const fluid::Grid grid({-2, -2, -2}, {2, 2, 2}, {28, 32, 24}, {.periodic = {true, true, false}});
  const Body body{peanut, Vector(1.713 - 8.0, -1.947, -0.071)};
  fluid::FaceVector field(grid);
  field.fill(3.0);
  for (int component = 0; component < 3; ++component) {
    const auto c = static_cast<std::size_t>(component);
    InsidePoints inside;
    inside.find(band_of(body, grid, fluid::face_centrings[c], 1.5 * grid.spacing(2)), grid.spacing(0));
    inside.multiply(0.5, grid, field.points()[c]);
    const fluid::ConstView values = std::as_const(field).points()[c];
    int changed = 0;
    for (int k = -1; k <= values.extent[2]; ++k)
      for (int j = -1; j <= values.extent[1]; ++j)
        for (int i = -1; i <= values.extent[0]; ++i) {
          const fluid::Vector3 x = fluid::point_position(grid, fluid::face_centrings[c], i, j, k);
          bool is_inside = false;
          for (int a = -4; a <= 1; ++a)
            for (int b = -2; b <= 2; ++b)
              is_inside = is_inside || body.level({x[0] + 4.0 * a, x[1] + 4.0 * b, x[2]}) < 0.0;
          changed += is_inside ? 1 : 0;
          EXPECT_EQ(values(i, j, k), is_inside ? 1.5 : 3.0) << component << ": " << i << " " << j << " " << k;
        }
    EXPECT_GT(changed, 100);
  }
}

// Of a body across mirror planes, and of one a sixth of a spacing off them: all points and those ghosts that are their mirror images. That
// of the component normal to the plane nobody reads.
TEST(InsidePoints, AreMultipliedInGhostsBeyondMirrorPlanesToo) {
  const fluid::Grid grid({0.3, -0.2, -2}, {3.3, 2.8, 2}, {24, 22, 28}, {.periodic = {}, .mirror = {true, true, false}});
  const double off = grid.spacing(0) / 6.0;
  for (const bool across : {true, false}) {
    const Body body{peanut, across ? Vector(0.3, -0.2, -0.071) : Vector(1.9 + off, 0.7 + off, -0.071)};
    for (int component = 0; component < 3; ++component) {
      const auto c = static_cast<std::size_t>(component);
      fluid::FaceVector field(grid);
      field.fill(3.0);
      FineSurface fine(0);
      fine.update(body.surface(), 0.9 * grid.min_spacing());
      GridBand band(grid, fluid::face_centrings[c], {across, across, across});
      band.update(fine, 1.5 * grid.spacing(2));
      InsidePoints inside;
      inside.find(band, grid.spacing(0));
      inside.multiply(0.5, grid, field.points()[c]);
      const fluid::ConstView values = std::as_const(field).points()[c];
      int changed = 0;
      for (int k = -1; k <= values.extent[2]; ++k)
        for (int j = -1; j <= values.extent[1]; ++j)
          for (int i = -1; i <= values.extent[0]; ++i) {
            if ((i == -1 && component == 0) || (j == -1 && component == 1)) continue;
            const fluid::Vector3 x = fluid::point_position(grid, fluid::face_centrings[c], i, j, k);
            const Vector in_box(std::max(x[0], 0.6 - x[0]), std::max(x[1], -0.4 - x[1]), x[2]);
            const bool is_inside = body.level(in_box) < 0.0;
            changed += is_inside ? 1 : 0;
            ASSERT_EQ(values(i, j, k), is_inside ? 1.5 : 3.0) << component << ": " << i << " " << j << " " << k;
          }
      EXPECT_GT(changed, 100);
    }
  }
}

TEST(InsidePoints, ABodyBetweenThePointsHasNone) {
  const fluid::Grid grid({-2, -2, -2}, {2, 2, 2}, {8, 8, 8});
  const Body body{[](const Vector&) { return 0.15; }, Vector(0.28, 0.23, 0.26)};
  InsidePoints inside;
  inside.find(band_of(body, grid, fluid::Centring::face_x, 0.8), grid.spacing(0));
  EXPECT_TRUE(inside.runs().empty());
  inside.find(band_of(body, grid, fluid::Centring::cell, 0.8), grid.spacing(0));
  ASSERT_EQ(inside.runs().size(), 1U);
  EXPECT_EQ(inside.runs()[0].last - inside.runs()[0].first, 1);
}

}  // namespace
}  // namespace vesiflow::coupling::inside_points_test
