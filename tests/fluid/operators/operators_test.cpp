// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/operators.h"

#include <gtest/gtest.h>

#include <vector>

#include "fluid/boundary.h"
#include "fluid/viscosity.h"
#include "test_fields.h"
#include "test_problems.h"

namespace vesiflow::fluid::operators_test {
namespace {

const std::array<Grid, 3> grids{Grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), Grid({0, -1, 0}, {1, 2, 5}, {7, 5, 11}),
                                Grid({-3, 0, 0}, {1, 1, 1}, {4, 13, 6})};

// Between walls, periodic, and every mixture.
std::vector<Grid> grids_with_all_boundaries() {
  std::vector<Grid> all;
  for (const Grid& grid : grids) {
    for (unsigned mask = 0; mask < 8; ++mask) all.push_back(test::with_periodic_axes(grid, mask));
  }
  return all;
}

// Random, zero on walls, ghosts set.
FaceVector random_flow(const Grid& grid, unsigned seed) {
  FaceVector u = test::random_velocity(grid, seed);
  const WallVelocity walls(grid, [](const Vector3&, double) { return Vector3{}; });
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  return u;
}

TEST(Operators, DivergenceIsMinusTheAdjointOfTheGradient) {
  for (const Grid& grid : grids_with_all_boundaries()) {
    Field<Cell> p(grid);
    test::fill_random(p.points(), 1);
    extend_to_ghosts(p);
    const FaceVector u = random_flow(grid, 2);
    FaceVector g(grid);
    Field<Cell> d(grid);
    gradient(p, g);
    divergence(u, d);
    const double scale = std::sqrt(test::dot(g, g) * test::dot(u, u));
    EXPECT_NEAR(test::dot(g, u), -test::dot(p.points(), d.points()), 1e-14 * scale);
  }
}

// <v, N(u)> vanishes for v = u: convection does no work, whether u is divergence-free or not.
TEST(Operators, ConvectionDoesNoWorkBetweenZeroWalls) {
  for (const Grid& grid : grids_with_all_boundaries()) {
    const FaceVector u = random_flow(grid, 5);
    FaceVector n(grid);
    convection(u, n);
    const double scale = std::sqrt(test::dot(n, n) * test::dot(u, u));
    EXPECT_GT(scale, 1.0);
    EXPECT_NEAR(test::dot(n, u), 0.0, 1e-14 * scale);
  }
}

// For a linear flow u = G r with zero trace, (u.grad)u = G G r, and all differences are exact but for the
// products, whose differences over 2h are exact for quadratics too.
TEST(Operators, ConvectionOfALinearFlowIsExact) {
  const Grid& grid = grids[1];
  const std::array<Vector3, 3> g{{{0.5, 2.0, -1.0}, {1.0, 0.25, 3.0}, {-1.0, 1.0, -0.75}}};
  const auto multiply = [&](const Vector3& r) {
    Vector3 product{};
    for (int a = 0; a < 3; ++a) product[a] = g[a][0] * r[0] + g[a][1] * r[1] + g[a][2] * r[2];
    return product;
  };
  FaceVector u(grid);
  const WallVelocity walls(grid, [&](const Vector3& r, double) { return multiply(r); });
  const auto fields = u.points();
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(fields[c].extent, [&](int i, int j, int k) {
      fields[c](i, j, k) = multiply(point_position(grid, static_cast<Centring>(c + 1), i, j, k))[c];
    });
  }
  walls.fill_ghosts(u);
  FaceVector n(grid);
  convection(u, n);
  EXPECT_LT(max_divergence(u), 1e-13);
  for (int c = 0; c < 3; ++c) {
    const auto centring = static_cast<Centring>(c + 1);
    std::array<int, 3> first{};
    first[c] = 1;
    const View unknowns = n.unknowns()[c];
    test::for_each_point(unknowns.extent, [&](int i, int j, int k) {
      const Vector3 r = point_position(grid, centring, i + first[0], j + first[1], k + first[2]);
      EXPECT_NEAR(unknowns(i, j, k), multiply(multiply(r))[c], 2e-13);
    });
  }
}

// A field of fewer cells would be read and written out of its bounds.
TEST(Operators, FieldsOfDifferentGridsAreRefused) {
  const Grid grid({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), coarse({0, 0, 0}, {1, 1, 1}, {8, 8, 4});
  Field<Cell> cells(coarse);
  FaceVector faces(grid), coarse_faces(coarse), mixed(Field<FaceX>{grid}, Field<FaceY>{grid}, Field<FaceZ>{coarse});
  EXPECT_THROW(gradient(cells, faces), std::invalid_argument);
  EXPECT_THROW(divergence(faces, cells), std::invalid_argument);
  EXPECT_THROW(max_divergence(mixed), std::invalid_argument);
  EXPECT_THROW(convection(faces, coarse_faces), std::invalid_argument);
  const WallVelocity walls(grid, [](const Vector3&, double) { return Vector3{}; });
  EXPECT_THROW(walls.set_normal_faces(coarse_faces), std::invalid_argument);
  EXPECT_THROW(walls.fill_ghosts(mixed), std::invalid_argument);
  EXPECT_THROW(walls.add_diffusion(1.0, coarse_faces), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::fluid::operators_test
