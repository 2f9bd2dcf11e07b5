#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "fluid/operators.h"
#include "fluid/stokes.h"
#include "test_fields.h"

namespace vesiflow::fluid {
namespace {

const Grid unequal({-1, 0, 0}, {1, 3, 1}, {15, 9, 21});

template <class FieldType>
double distance_from_zero_mean(const FieldType& p) {
  double sum = 0.0;
  test::for_each_point(p.extent(), [&](int i, int j, int k) { sum += p(i, j, k); });
  return sum / static_cast<double>(p.grid().cell_count());
}

// Linear flows have no viscous force: the exact solution with p = 0.
TEST(Stokes, LinearFlowsAreReproduced) {
  const auto shear = [](const Vector3& r, double) { return Vector3{r[2] + 0.5, 0.0, 0.0}; };
  const auto extension = [](const Vector3& r, double) { return Vector3{r[0], r[1] - 0.3 * r[2], -2 * r[2]}; };
  for (const BoundaryVelocity& flow : {BoundaryVelocity(shear), BoundaryVelocity(extension)}) {
    const WallVelocity walls(unequal, flow, true);
    StokesSolver solver(unequal);
    const FaceVector force(unequal);
    FaceVector u(unequal);
    Field<Cell> p(unequal);
    const StokesReport report = solver.solve(force, walls, u, p);
    EXPECT_TRUE(report.converged);
    double error = 0.0;
    for (int c = 0; c < 3; ++c) {
      const ConstView view = std::as_const(u).points()[c];
      test::for_each_point(view.extent, [&](int i, int j, int k) {
        const Vector3 r = point_position(unequal, face_centrings[c], i, j, k);
        error = std::max(error, std::abs(view(i, j, k) - flow(r, 0.0)[c]));
      });
    }
    EXPECT_LT(error, 3e-7);
    EXPECT_LT(test::max_abs(p.points()), 3e-6);
    EXPECT_LT(report.momentum_residual, 1e-12);
  }
}

}  // namespace
}  // namespace vesiflow::fluid
