// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/boundary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "fluid/elliptic_problem.h"
#include "fluid/operators.h"
#include "test_fields.h"

namespace vesiflow::fluid::boundary_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({-1.0, 0.0, -2.0}, {1.0, 1.5, 2.0}, {5, 4, 7});

// A linear flow without divergence, with every velocity gradient in it.
Vector3 linear_flow(const Vector3& r, double) {
  const auto [x, y, z] = r;
  return {1.0 + 0.5 * x + 2.0 * y - z, -2.0 + x + 0.25 * y + 3.0 * z, 0.5 - x + y - 0.75 * z};
}

template <class Centring>
void sample_inside(int component, Field<Centring>& field) {
  test::for_each_point(field.extent(), [&](int i, int j, int k) {
    field(i, j, k) = linear_flow(field.position(i, j, k), 0.0)[component];
  });
}

template <class Centring>
double ghost_error(int component, const Field<Centring>& field) {
  double error = 0.0;
  for (int k = -1; k <= field.extent(2); ++k) {
    for (int j = -1; j <= field.extent(1); ++j) {
      for (int i = -1; i <= field.extent(0); ++i) {
        error = std::max(error, std::abs(field(i, j, k) - linear_flow(field.position(i, j, k), 0.0)[component]));
      }
    }
  }
  return error;
}

TEST(WallVelocity, ContinuesALinearFlowExactlyIntoAllGhosts) {
  const WallVelocity walls(grid, linear_flow);
  FaceVector u(grid);
  sample_inside(0, u.x);
  sample_inside(1, u.y);
  sample_inside(2, u.z);
  walls.set_normal_faces(u);
  walls.fill_ghosts(u);
  EXPECT_LT(ghost_error(0, u.x), 1e-14);
  EXPECT_LT(ghost_error(1, u.y), 1e-14);
  EXPECT_LT(ghost_error(2, u.z), 1e-14);
}

// The Laplacian of a linear flow is zero: the walls' part cancels what the homogeneous operator leaves.
TEST(WallVelocity, DiffusionFromTheWallsCompletesTheHomogeneousLaplacian) {
  const double mu = 1.75;
  const WallVelocity walls(grid, linear_flow);
  FaceVector u(grid);
  sample_inside(0, u.x);
  sample_inside(1, u.y);
  sample_inside(2, u.z);
  FaceVector sum(grid);
  for (int component = 0; component < 3; ++component) {
    const auto centring = static_cast<Centring>(component + 1);
    const View view = sum.unknowns()[component];
    apply(EllipticProblem(grid, centring, BoundaryCondition::dirichlet, 0.0, mu), u.unknowns()[component], view);
    test::for_each_point(view.extent, [&](int i, int j, int k) { view(i, j, k) *= -1.0; });
  }
  walls.add_diffusion(mu, sum);
  for (const View& component : sum.unknowns()) EXPECT_LT(test::max_abs(component), 1e-12);
}

TEST(WallVelocity, RefusesANetFluxAndSaysHowMuch) {
  // u = (x, 0, 0) expands the box of volume 12.
  EXPECT_THAT([] { WallVelocity(grid, [](const Vector3& r, double) {
                     return Vector3{r[0], 0, 0};
                   }); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("net outward flux"), HasSubstr("12"))));
}

TEST(WallVelocity, SpreadsTheSamplingErrorOfBalancedData) {
  // Zero flux in the integral; the samples on either wall miss it by different errors.
  const auto flow = [](const Vector3& r, double) {
    return Vector3{r[0] > 0 ? 1.5 * r[1] * r[1] / 1.125 : 1.0, 0.0, 0.0};
  };
  const WallVelocity walls(grid, flow);
  EXPECT_GT(std::abs(walls.net_flux()), 1e-3);
  FaceVector u(grid);
  walls.set_normal_faces(u);
  Field<Cell> d(grid);
  divergence(u, d);
  double total = 0.0;
  test::for_each_point(d.extent(), [&](int i, int j, int k) { total += d(i, j, k); });
  EXPECT_NEAR(total * grid.cell_volume(), 0.0, 1e-13);
}

TEST(WallVelocity, RefusesValuesThatAreNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT([&] { WallVelocity(grid, [=](const Vector3&, double) {
                      return Vector3{0, infinity, 0};
                    }); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("component 1 is inf")));
}

TEST(WallVelocity, SamplesSteadyDataOnceAndOtherDataAtEachNewTime) {
  for (const WallMotion motion : {WallMotion::steady, WallMotion::unsteady}) {
    const bool steady = motion == WallMotion::steady;
    int calls = 0;
    WallVelocity walls(
        grid, [&](const Vector3&, double) { return ++calls, Vector3{}; }, motion);
    EXPECT_EQ(walls.steady(), steady);
    const int once = calls;
    walls.evaluate(0.5);
    EXPECT_EQ(calls, steady ? once : 2 * once);
    walls.evaluate(0.5);
    EXPECT_EQ(calls, steady ? once : 2 * once);
  }
}

}  // namespace
}  // namespace vesiflow::fluid::boundary_test
