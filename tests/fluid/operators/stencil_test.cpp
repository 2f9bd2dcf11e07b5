// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The operators of EllipticProblem: symmetry, energy, closed forms, order.
#include "operators/stencil.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "fluid/operators.h"
#include "test_problems.h"

namespace vesiflow::fluid::stencil_test {
namespace {

using test::Numbers;
using VectorFunction = std::function<Vector3(const Vector3&)>;

const Grid small_grid({0, 0, 0}, {1, 1.4, 0.9}, {5, 6, 4});

TEST(EllipticOperator, IsSymmetricAndPositiveForEveryKindAndTopology) {
  for (const test::Kind& kind : test::all_kinds) {
    for (const test::Topology& topology : test::all_topologies()) {
      const Grid grid = test::with_topology(small_grid, topology);
      for (const Viscosity& mu : {Viscosity(0.7), Viscosity(test::wavy_viscosity(grid, 20.0))}) {
        SCOPED_TRACE(testing::Message() << kind.name << ", " << topology << ", constant " << mu.is_constant());
        const EllipticProblem problem = kind.problem(grid, 0.0, mu);
        const Numbers x(problem, 51);
        const Numbers y(problem, 52);
        const Numbers ax(problem);
        const Numbers ay(problem);
        apply(problem, x, ax);
        apply(problem, y, ay);
        EXPECT_NEAR(y.dot(ax), x.dot(ay), 1e-14 * x.norm() * ay.norm());
        EXPECT_GT(x.dot(ax), 0.0);
        // alpha adds alpha <x, x>.
        const Numbers shifted(problem);
        apply(kind.problem(grid, 3.0, mu), x, shifted);
        EXPECT_NEAR(x.dot(shifted) - x.dot(ax), 3.0 * x.dot(x), 1e-13 * x.norm() * ax.norm());
      }
    }
  }
}

TEST(EllipticOperator, ConstantsAreTheNullspaceWithoutDirichletWalls) {
  for (const test::Kind& kind : test::all_kinds) {
    const Grid grid = test::with_periodic_axes(small_grid, 7);
    const EllipticProblem problem = kind.problem(grid, 0.0, Viscosity(test::wavy_viscosity(grid, 20.0)));
    ASSERT_TRUE(problem.has_nullspace());
    Numbers x(problem);
    for (int block = 0; block < problem.blocks(); ++block) x.add_to_block(block, 2.0 + block);
    const Numbers y(problem);
    apply(problem, x, y);
    EXPECT_LT(y.norm(), 1e-10) << kind.name;  // mu / h^2 is up to 700, and so round-off 1e-13 a term
    EXPECT_FALSE(kind.problem(grid, 0.1, 1.0).has_nullspace());
  }
}

// -div(mu grad u + ...) at one row, with u given everywhere, on walls and beyond too; component by component.
double stress(const Grid& grid, const FaceVector& u, const Viscosity& mu, int component, int i, int j, int k) {
  std::array<double, 16> out{};
  add_stress_row(grid, u.points(), CoefficientView(grid, mu), 0.0, 1.0, component, j, k, out.data());
  return out[i];
}

FaceVector sampled(const Grid& grid, const VectorFunction& u) {
  FaceVector field(grid);
  const auto views = field.points();
  for (int c = 0; c < 3; ++c) {
    const auto& n = views[c].extent;
    for (int k = -1; k <= n[2]; ++k) {
      for (int j = -1; j <= n[1]; ++j) {
        for (int i = -1; i <= n[0]; ++i) views[c](i, j, k) = u(point_position(grid, face_centrings[c], i, j, k))[c];
      }
    }
  }
  return field;
}

void for_each_component_and_unknown(const Grid& grid, const std::function<void(int, int, int, int)>& visit) {
  for (int c = 0; c < 3; ++c) {
    const Centring centring = face_centrings[c];
    test::for_each_point(unknown_extent(grid, centring), [&](int i, int j, int k) {
      visit(c, i + first_unknown(grid, centring, 0), j + first_unknown(grid, centring, 1),
            k + first_unknown(grid, centring, 2));
    });
  }
}

TEST(StressForm, ARigidRotationHasNoStressHoweverTheViscosityVaries) {
  const FaceVector u = sampled(small_grid, [](const Vector3& r) {
    return Vector3{2.0 * r[1] - 3.0 * r[2] + 1.0, -2.0 * r[0] + 5.0 * r[2], 3.0 * r[0] - 5.0 * r[1]};
  });
  const Viscosity mu(test::wavy_viscosity(small_grid, 20.0));
  for_each_component_and_unknown(small_grid, [&](int c, int i, int j, int k) {
    EXPECT_NEAR(stress(small_grid, u, mu, c, i, j, k), 0.0, 1e-10);  // mu u / h^2 is up to 1e4
  });
}

// A linear flow u = G r has the stress mu (G + G^T), whose divergence is (G + G^T) grad mu: exact for a linear mu.
TEST(StressForm, LinearFlowInLinearViscosity) {
  const std::array<Vector3, 3> g{{{1.0, 2.0, -0.5}, {0.3, -2.0, 4.0}, {1.5, 0.7, 0.25}}};
  const Vector3 slope{0.5, 0.2, 0.8};
  const FaceVector u = sampled(small_grid, [&](const Vector3& r) {
    Vector3 value{};
    for (int c = 0; c < 3; ++c) value[c] = g[c][0] * r[0] + g[c][1] * r[1] + g[c][2] * r[2];
    return value;
  });
  const auto mu = std::make_shared<Field<Cell>>(small_grid);
  const auto n = mu->extent();
  for (int k = -1; k <= n[2]; ++k) {
    for (int j = -1; j <= n[1]; ++j) {
      for (int i = -1; i <= n[0]; ++i) {
        const Vector3 r = mu->position(i, j, k);
        (*mu)(i, j, k) = 3.0 + slope[0] * r[0] + slope[1] * r[1] + slope[2] * r[2];
      }
    }
  }
  for_each_component_and_unknown(small_grid, [&](int c, int i, int j, int k) {
    double exact = 0.0;
    for (int d = 0; d < 3; ++d) exact += (g[c][d] + g[d][c]) * slope[d];
    EXPECT_NEAR(stress(small_grid, u, Viscosity(mu), c, i, j, k), exact, 1e-11);
  });
}

// div(grad u + grad u^T) = Lap u + grad div u, for the discrete operators too.
TEST(StressForm, IsTheLaplacianAndTheGradientOfTheDivergence) {
  const Grid grid = test::with_periodic_axes(small_grid, 7);
  const double mu = 1.7;
  const auto stress_problem = EllipticProblem::velocity(grid, EllipticForm::stress, 0.0, mu);
  const auto laplacian_problem = EllipticProblem::velocity(grid, EllipticForm::laplacian, 0.0, mu);
  const Numbers u(stress_problem, 53);
  const Numbers a(stress_problem);
  const Numbers b(stress_problem);
  apply(stress_problem, u, a);
  apply(laplacian_problem, u, b);
  const std::array<int, 3> n = grid.cells;
  const auto divergence_at = [&](std::array<int, 3> cell) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      cell[d] = (cell[d] + n[d]) % n[d];
      auto next = cell;
      next[d] = (next[d] + 1) % n[d];
      const View& view = u.block(d);
      sum += (view(next[0], next[1], next[2]) - view(cell[0], cell[1], cell[2])) / grid.spacing(d);
    }
    return sum;
  };
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(n, [&](int i, int j, int k) {
      std::array<int, 3> below{i, j, k};
      below[c] = (below[c] + n[c] - 1) % n[c];
      const double gradient = (divergence_at({i, j, k}) - divergence_at(below)) / grid.spacing(c);
      EXPECT_NEAR(a.block(c)(i, j, k), b.block(c)(i, j, k) - mu * gradient, 1e-10);
    });
  }
}

// Closed forms: mu = 1 + 0.5 sin x cos y + 0.3 sin z, and u_c = sin(x + c) sin(2 y + c) cos(z) of period 2 pi, so that
// there are no walls; the derivatives of the flux by differences of the closed form's fluxes would be no test, so
// by hand: div(mu grad u) = mu Lap u + grad mu . grad u, and for the stress form also
// mu d_c div u + sum_d d_d mu d_c u_d.
struct Smooth {
  static double mu(const Vector3& r) { return 1.0 + 0.5 * std::sin(r[0]) * std::cos(r[1]) + 0.3 * std::sin(r[2]); }
  static Vector3 mu_gradient(const Vector3& r) {
    return {0.5 * std::cos(r[0]) * std::cos(r[1]), -0.5 * std::sin(r[0]) * std::sin(r[1]), 0.3 * std::cos(r[2])};
  }
  static double u(int c, const Vector3& r) { return std::sin(r[0] + c) * std::sin(2.0 * r[1] + c) * std::cos(r[2]); }
  static Vector3 u_gradient(int c, const Vector3& r) {
    return {std::cos(r[0] + c) * std::sin(2.0 * r[1] + c) * std::cos(r[2]),
            2.0 * std::sin(r[0] + c) * std::cos(2.0 * r[1] + c) * std::cos(r[2]),
            -std::sin(r[0] + c) * std::sin(2.0 * r[1] + c) * std::sin(r[2])};
  }
  // d^2 u_c / dx_a dx_b.
  static double u_second(int c, int a, int b, const Vector3& r) {
    const std::array<double, 3> value{std::sin(r[0] + c), std::sin(2.0 * r[1] + c), std::cos(r[2])};
    const std::array<double, 3> first{std::cos(r[0] + c), 2.0 * std::cos(2.0 * r[1] + c), -std::sin(r[2])};
    const std::array<double, 3> second{-value[0], -4.0 * value[1], -value[2]};
    double product = 1.0;
    for (int d = 0; d < 3; ++d) product *= d == a && d == b ? second[d] : d == a || d == b ? first[d] : value[d];
    return product;
  }
  static double force(EllipticForm form, int c, const Vector3& r) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
      sum += mu(r) * u_second(c, d, d, r) + mu_gradient(r)[d] * u_gradient(c, r)[d];
      if (form == EllipticForm::stress) sum += mu(r) * u_second(d, c, d, r) + mu_gradient(r)[d] * u_gradient(d, r)[c];
    }
    return -sum;
  }
};

double operator_error(EllipticForm form, int cells) {
  const double length = 2.0 * std::numbers::pi;
  const Grid grid({0, 0, 0}, {length, length, length}, {cells, cells * 7 / 6, cells * 11 / 12},
                  {.periodic = {true, true, true}});
  const auto problem = EllipticProblem::velocity(grid, form, 0.0, Viscosity(sample_viscosity(grid, Smooth::mu)));
  const Numbers u(problem);
  const Numbers result(problem);
  const auto position = [&](int c, int i, int j, int k) { return point_position(grid, face_centrings[c], i, j, k); };
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(problem.extent(c),
                         [&](int i, int j, int k) { u.block(c)(i, j, k) = Smooth::u(c, position(c, i, j, k)); });
  }
  apply(problem, u, result);
  double error = 0.0;
  for (int c = 0; c < 3; ++c) {
    test::for_each_point(problem.extent(c), [&](int i, int j, int k) {
      error = std::max(error, std::abs(result.block(c)(i, j, k) - Smooth::force(form, c, position(c, i, j, k))));
    });
  }
  return error;
}

TEST(VariableOperators, ConvergeToTheClosedFormInSecondOrder) {
  for (const EllipticForm form : {EllipticForm::laplacian, EllipticForm::stress}) {
    const double coarse = operator_error(form, 24);
    const double fine = operator_error(form, 48);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << name(form) << ": " << coarse << ", " << fine;
    EXPECT_LT(fine, 0.1);  // forces are up to 10
  }
}

// A field of equal values is a number.
TEST(VariableOperators, AgreeWithTheConstantOnes) {
  for (const test::Kind& kind : test::all_kinds) {
    for (const int mask : {0, 5}) {
      const Grid grid = test::with_periodic_axes(small_grid, mask);
      const Viscosity field(sample_viscosity(grid, [](const Vector3&) { return 1.3; }));
      const EllipticProblem problem = kind.problem(grid, 2.0, 1.3);
      const Numbers x(problem, 54);
      const Numbers y(problem);
      const Numbers z(problem);
      apply(problem, x, y);
      apply(kind.problem(grid, 2.0, field), x, z);
      EXPECT_LT(y.max_difference(z), 1e-12) << kind.name;
    }
  }
}

}  // namespace
}  // namespace vesiflow::fluid::stencil_test
