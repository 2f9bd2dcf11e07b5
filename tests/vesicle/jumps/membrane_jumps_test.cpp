// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The jumps against those of pairs of exact Stokes flows.
#include "vesicle/membrane_jumps.h"

#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "jumps/exact_jumps.h"
#include "support.h"
#include "vesicle/shapes.h"

namespace vesiflow::vesicle::membrane_jumps_test {
namespace {

using testing::ExactJumps;
using testing::Flow;
using testing::jump_names;
using testing::LambTerm;
using testing::line;

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
}

Surface surface_at(const VectorField& positions, const SphereGrid& grid) {
  Surface surface(grid);
  surface.update(positions);
  return surface;
}

Eigen::ArrayXXd jumps_of(const Surface& surface, const VectorField& force) {
  MembraneJumps jumps(surface.grid());
  jumps.update(surface);
  jumps.compute(force);
  return jumps.at_markers();
}

Eigen::ArrayXXd jumps_of(const Surface& surface, const VectorField& force, const VectorField& velocity_jump) {
  MembraneJumps jumps(surface.grid());
  jumps.update(surface);
  jumps.compute(force, velocity_jump);
  return jumps.at_markers();
}

void expect_errors_below(double tolerance, const Eigen::ArrayXXd& found, const ExactJumps& exact) {
  const auto errors = testing::errors(found, exact.columns);
  for (std::size_t i = 0; i < errors.size(); ++i) EXPECT_LT(errors[i], tolerance) << jump_names[i].name;
}

/// The test's own flows: div u = 0, Lap u = grad p, by differences of fourth order of their exact first derivatives. As
/// everything below is true of them only then.
void expect_stokes(const Flow& flow, const Vector3& x) {
  constexpr double h = 1e-3;
  const auto slope = [&](const Vector3& at, int axis) { return flow(line(at, Vector3::Unit(axis))); };
  double divergence = 0, scale = 0;
  Vector3 laplacian = Vector3::Zero(), pressure_gradient;
  for (int axis = 0; axis < 3; ++axis) {
    divergence += slope(x, axis).velocity[std::size_t(axis)].derivative(1);
    pressure_gradient[axis] = slope(x, axis).pressure.derivative(1);
    for (int i = 0; i < 3; ++i) {
      const auto g = [&](double s) {
        return slope(x + s * h * Vector3::Unit(axis), axis).velocity[std::size_t(i)].derivative(1);
      };
      laplacian[i] += (8 * (g(1) - g(-1)) - (g(2) - g(-2))) / (12 * h);
      scale = std::max(scale, std::abs(g(0)));
    }
  }
  EXPECT_LT(std::abs(divergence), 1e-13 * scale);
  EXPECT_LT((laplacian - pressure_gradient).norm(), 1e-9 * scale);
}

/// Singularities outside, for the flow inside, and the other way round. None of them has a symmetry.
Flow flow_inside() {
  return testing::stokeslet({0, 0, 3}, {1, 0.5, -0.3}) + testing::stokeslet({2, 1, 0}, {0.2, 0.5, 0.9}) +
         testing::stresslet({-2, 0.3, 0.4}, {1, 0, 0.3}, {0.2, 0.5, -0.6}) +
         0.1 * testing::parabolic({1, 0, 2}, {0, 1, 0});
}
Flow flow_outside() {
  return testing::stokeslet({0.1, 0, 0.1}, {-0.3, 0.5, 1}) +
         0.3 * testing::stresslet({0, 0.05, -0.1}, {0.2, 0.4, 0.3}, {0.2, -0.5, 0.6}) +
         0.2 * testing::source({-0.05, 0, 0});
}

TEST(MembraneJumps, TheFlowsOfTheseTestsAreStokesFlows) {
  const Eigen::Matrix3d r = some_rotation();
  const Vector3 x(0.7, -0.5, 0.9);
  expect_stokes(flow_inside(), x);
  expect_stokes(flow_outside(), x);
  expect_stokes(testing::moved(flow_outside(), r, {0.1, 0.2, -0.3}), x);
  for (int n = 2; n <= 5; ++n)
    for (const bool outside : {false, true}) expect_stokes(LambTerm{r.col(0), r.col(1), n, outside, 1.3, -0.4, 0.7}, x);
}

/// Lamb's solution with the same velocity inside and outside, of degrees 2 to 5 in a general direction: with three
/// independent amplitudes these are the general forces of one degree. Measured at most 1.1e-13 (16 latitudes), 1.4e-12
/// (32), 9.5e-12 (64), of [p_nn]: round-off, which second derivatives multiply by 1 / sin^2 of the first latitude.
TEST(MembraneJumps, OfLambsSolutionWithAContinuousVelocity) {
  const Eigen::Matrix3d r = some_rotation();
  for (const int latitudes : {16, 32, 64}) {
    const SphereGrid grid(latitudes);
    const Surface surface = surface_at(sphere(grid), grid);
    for (int n = 2; n <= 5; ++n)
      for (const Vector3& amplitudes :
           {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(1.3, -0.4, 0.7)}) {
        const LambTerm inside{r.col(0), r.col(1), n, false, amplitudes[0], amplitudes[1], amplitudes[2]};
        const ExactJumps exact(surface, inside, inside.continued());
        ASSERT_LT(exact.velocity_jump.abs().maxCoeff(), 3e-14);
        const Eigen::ArrayXXd found = jumps_of(surface, exact.force);
        ASSERT_EQ(found.cols(), JumpColumns::without_velocity_jump);
        const double scale = exact.columns.rightCols(6).abs().maxCoeff(), tolerance = 2e-15 * latitudes * latitudes;
        for (const auto& jump : jump_names) {
          if (jump.column >= found.cols()) continue;
          const auto wanted = exact.columns.middleCols(jump.column, jump.columns);
          EXPECT_LT((found.middleCols(jump.column, jump.columns) - wanted).abs().maxCoeff(), tolerance * scale)
              << jump.name << ' ' << n << ' ' << amplitudes.transpose() << ' ' << latitudes;
        }
      }
  }
}

/// With different terms inside and outside all quantities jump.
TEST(MembraneJumps, OfLambsSolutionWithAJumpOfVelocity) {
  const Eigen::Matrix3d r = some_rotation();
  for (const int latitudes : {16, 32}) {
    const SphereGrid grid(latitudes);
    const Surface surface = surface_at(sphere(grid), grid);
    for (int n = 2; n <= 5; ++n) {
      const LambTerm inside{r.col(0), r.col(1), n, false, 1.3, -0.4, 0.7};
      const LambTerm outside{r.col(1), r.col(2), 7 - n, true, 0.3, 0.4, 0.7};
      const ExactJumps exact(surface, inside, outside);
      expect_errors_below(3e-14 * latitudes * latitudes, jumps_of(surface, exact.force, exact.velocity_jump), exact);
    }
  }
}

struct Body {
  const char* name;
  std::function<VectorField(const SphereGrid&)> shape;
};

std::vector<Body> bodies() {
  const Harmonic dents[] = {{2, 0, -0.35}, {3, 2, 0.12}, {4, -3, 0.08}, {4, 0, 0.1}};
  return {{"1:1:2",
           [](const SphereGrid& grid) {
             return ellipsoid(grid, {1, 1, 2});
           }},
          {"1:1.3:2",
           [](const SphereGrid& grid) {
             return ellipsoid(grid, {1, 1.3, 2});
           }},
          {"dented", [=](const SphereGrid& grid) { return perturbed_sphere(grid, dents); }}};
}

/// Fields of all degrees on bodies that are no spheres, so that every term with curvature and its gradient counts. The errors
/// fall geometrically, as the nearest singularities say. Measured: from 24 latitudes on by 7 and more for every 8 latitudes, and
/// at 48 1.4e-5 of [u_nnn] and 7e-6 or less of the others, on all three bodies.
TEST(MembraneJumps, ConvergeSpectrallyToThoseOfTwoStokesFlows) {
  for (const Body& body : bodies()) {
    std::array<double, jump_names.size()> before{};
    for (const int latitudes : {24, 32, 40, 48}) {
      const SphereGrid grid(latitudes);
      const Surface surface = surface_at(body.shape(grid), grid);
      const ExactJumps exact(surface, flow_inside(), flow_outside());
      const auto now = testing::errors(jumps_of(surface, exact.force, exact.velocity_jump), exact.columns);
      EXPECT_EQ(now.back(), 0) << "[u] is as it was given";
      for (std::size_t i = 0; i + 1 < now.size(); ++i) {
        const double rate = before[i] / now[i];
        EXPECT_TRUE(latitudes == 24 || rate > 5)
            << jump_names[i].name << ' ' << body.name << ' ' << latitudes << ' ' << rate;
        EXPECT_TRUE(latitudes < 48 || now[i] < 3e-5) << jump_names[i].name << ' ' << body.name << ' ' << now[i];
      }
      before = now;
    }
  }
}

/// A uniform pressure difference needs F = n, and nothing else jumps: all terms of a constant [p] must cancel out.
TEST(MembraneJumps, OfAUniformPressure) {
  const SphereGrid grid(32);
  for (const Body& body : bodies()) {
    const Surface surface = surface_at(body.shape(grid), grid);
    Eigen::ArrayXXd jumps = jumps_of(surface, surface.normal());
    jumps.col(JumpColumns::pressure) -= 1;
    EXPECT_LT(jumps.abs().maxCoeff(), 1e-10) << body.name;
  }
}

/// Stokes' momentum balance is used on the membrane and in its normal derivative. With inertia the first stays, as
/// r = [Lap u - grad p] = Re [Du/Dt] is zero where the velocity is continuous; r_n is not. [p_nn] lacks -n . r_n then and
/// [u_nnn] the tangential part of r_n, and nothing else changes (docs/jump_conditions.md). The jump here is
/// u = s grad h x x, p = c (|x|^2 - 1)^2 h on the unit sphere, h of degree n, s(|x|^2) such that r = 0.
TEST(MembraneJumps, WithInertiaLackWhatTheSecondNormalDerivativesHaveOfIt) {
  const Eigen::Matrix3d rotation = some_rotation();
  const SphereGrid grid(24);
  const Surface surface = surface_at(sphere(grid), grid);
  for (const int n : {2, 3}) {
    constexpr double a = 0.8, c = 0.3;
    const double b = -a * (2 * n + 3) / 4;
    const Flow jump = [&](const testing::TaylorVector& x) {
      const testing::SolidHarmonic h = solid_harmonic(rotation.col(0), rotation.col(1), n, false, x);
      const testing::Taylor w = dot(x, x) - 1.0;
      return testing::FlowValue{(a * w + b * w * w) * cross(h.gradient, x), c * w * w * h.value};
    };
    const Flow inside = LambTerm{rotation.col(1), rotation.col(2), 3, false, 1, 0.5, 0.2};
    const ExactJumps exact(surface, inside, inside + jump);
    VectorField tangential(grid.size(), 3);  // of r_n
    ScalarField normal(grid.size());
    for (Eigen::Index k = 0; k < grid.size(); ++k) {
      const Vector3 x = surface.positions().row(k).matrix().transpose();
      const auto h = solid_harmonic(rotation.col(0), rotation.col(1), n, false, line(x, x));
      const testing::TaylorVector v = cross(h.gradient, line(x, x));
      for (int i = 0; i < 3; ++i) tangential(k, i) = (24 + 16 * (n + 1)) * b * v[std::size_t(i)].derivative(0);
      normal[k] = -8 * c * h.value.derivative(0);
    }
    Eigen::ArrayXXd found = jumps_of(surface, exact.force);
    ASSERT_GT((found - exact.columns.leftCols(found.cols())).abs().maxCoeff(), 1);
    found.col(JumpColumns::pressure_second_normal) -= normal;
    found.middleCols<3>(JumpColumns::velocity_third_normal) += tangential;
    EXPECT_LT((found - exact.columns.leftCols(found.cols())).abs().maxCoeff(), 1e-12 * exact.columns.abs().maxCoeff());
  }
}

/// Turned and moved along with the mesh and its fields; the numbers differ by rounding only, which [u_nnn] magnifies most.
TEST(MembraneJumps, TurnAndMoveWithTheBody) {
  const Eigen::Matrix3d rotation = some_rotation();
  const SphereGrid grid(20);
  const VectorField positions = bodies()[2].shape(grid);
  const VectorField force = testing::smooth_vector(grid, 6, 1), velocity_jump = testing::smooth_vector(grid, 6, 2);
  const auto turned = [&](const Eigen::ArrayXXd& v) { return (v.matrix() * rotation.transpose()).array().eval(); };
  Eigen::ArrayXXd expected = jumps_of(surface_at(positions, grid), force, velocity_jump);
  for (int column = JumpColumns::velocity_normal; column < expected.cols(); column += 3)
    expected.middleCols<3>(column) = turned(expected.middleCols<3>(column));
  VectorField moved = turned(positions);
  moved.rowwise() += Eigen::Array<double, 1, 3>(0.3, -0.2, 0.5);
  const Eigen::ArrayXXd found = jumps_of(surface_at(moved, grid), turned(force), turned(velocity_jump));
  EXPECT_LT((found - expected).abs().maxCoeff(), 1e-11 * expected.abs().maxCoeff());
}

TEST(MembraneJumps, AreLinearInForceAndVelocityJump) {
  const SphereGrid grid(16);
  const Surface surface = surface_at(bodies()[2].shape(grid), grid);
  const VectorField f = testing::smooth_vector(grid, 6, 1), g = testing::smooth_vector(grid, 6, 2);
  const VectorField q = testing::smooth_vector(grid, 6, 3), r = testing::smooth_vector(grid, 6, 4);
  const Eigen::ArrayXXd one = jumps_of(surface, f, q), other = jumps_of(surface, g, r);
  const Eigen::ArrayXXd both = jumps_of(surface, 2 * f - 3 * g, 2 * q - 3 * r);
  EXPECT_LT((both - 2 * one + 3 * other).abs().maxCoeff(), 1e-12 * both.abs().maxCoeff());
  const Eigen::ArrayXXd alone = jumps_of(surface, f),
                        with_zero = jumps_of(surface, f, VectorField::Zero(grid.size(), 3));
  EXPECT_LT((with_zero.leftCols(alone.cols()) - alone).abs().maxCoeff(), 1e-13 * alone.abs().maxCoeff());
  EXPECT_TRUE((with_zero.rightCols<3>() == 0).all());
}

}  // namespace
}  // namespace vesiflow::vesicle::membrane_jumps_test
