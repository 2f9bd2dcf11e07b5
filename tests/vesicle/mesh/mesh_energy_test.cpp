// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/mesh_energy.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"

namespace vesiflow::vesicle::mesh_energy_test {
namespace {

using testing::random_coefficients;
using testing::smooth_vector;

constexpr MeshEnergyDescent::Metric damped{.damping = 1}, floored{.lowest_degree = 2};

double largest(const VectorField& field) {
  return field.abs().maxCoeff();
}

VectorField tangential(const Surface& surface, const VectorField& field) {
  return field - surface.normal().colwise() * ScalarField((field * surface.normal()).rowwise().sum());
}

/// Smooth, without symmetry, and with a mesh that is not the best.
Surface some_surface(int latitudes) {
  Surface surface(latitudes);
  const VectorField x = spheroid(surface.grid(), 0.6);
  surface.update(x + 0.05 * smooth_vector(surface.grid(), 5, 3));
  return surface;
}

double energy_of(const SphericalHarmonics& transform, const VectorField& positions) {
  Coefficients coefficients;
  transform.analysis(positions, coefficients);
  return mesh_energy(coefficients);
}

/// Over the parameter sphere, as E is.
double inner(const SphereGrid& grid, const VectorField& a, const VectorField& b) {
  double sum = 0;
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      sum += grid.weight()[j] * grid.longitude_spacing() * (a.row(grid.index(i, j)) * b.row(grid.index(i, j))).sum();
  return sum;
}

TEST(MeshEnergy, IsZeroForEllipsoidsAndTheWeightedSumOfSquaresElse) {
  EXPECT_EQ(mesh_energy_weight(0), 0);
  EXPECT_EQ(mesh_energy_weight(1), 0);
  EXPECT_EQ(mesh_energy_weight(2), 24);
  EXPECT_EQ(mesh_energy_weight(3), 120);
  const SphericalHarmonics transform(12, SphereGrid(12));
  EXPECT_LT(energy_of(transform, ellipsoid(transform.grid(), Vector3(1, 2, 4))), 1e-24);
  Coefficients c(5, 3);
  c.set_zero();
  c(1, 3, 2) = {2, 1};
  c(0, 2, 0) = {3, 0};
  EXPECT_DOUBLE_EQ(mesh_energy(c), (120 * 2 * 5 + 24 * 9) / 2.0);
}

TEST(MeshEnergyDescent, ForceIsMinusTheDerivativeByTangentialDisplacements) {
  const Surface surface = some_surface(16);
  MeshEnergyDescent descent(floored);
  VectorField force;
  descent.force(surface.harmonics(), surface, force);
  EXPECT_LT((force * surface.normal()).rowwise().sum().abs().maxCoeff(), 1e-13 * largest(force));
  // E is quadratic, so that central differences are exact.
  const VectorField along = tangential(surface, smooth_vector(surface.grid(), 4, 7));
  const double step = 1e-3;
  const double slope = (energy_of(surface.harmonics(), surface.positions() + step * along) -
                        energy_of(surface.harmonics(), surface.positions() - step * along)) /
                       (2 * step);
  EXPECT_NEAR(slope, -inner(surface.grid(), force, along), 1e-9 * std::abs(slope));
}

TEST(MeshEnergyDescent, DirectionIsThePreconditionedForceAndLeadsDown) {
  const Surface surface = some_surface(16);
  const SphericalHarmonics few(10, surface.grid());
  for (const MeshEnergyDescent::Metric& metric : {damped, floored}) {
    MeshEnergyDescent descent(metric);
    VectorField force, preconditioned, direction;
    descent.force(few, surface, force);
    descent.precondition(few, surface, force, preconditioned);
    descent.direction(few, surface, direction);
    EXPECT_EQ(largest(direction - preconditioned), 0);
    EXPECT_GT(inner(surface.grid(), force, direction), 0);
    // How far down it leads depends on the metric; at which slope does not. (E is quadratic: the central difference is exact.)
    const double step = 1e-3, slope = (energy_of(few, surface.positions() + step * direction) -
                                       energy_of(few, surface.positions() - step * direction)) /
                                      (2 * step);
    EXPECT_NEAR(slope, -inner(surface.grid(), force, direction), 1e-9 * std::abs(slope));
  }
}

TEST(MeshEnergyDescent, SecondDerivativeAndPreconditionerAreSymmetricAndPositive) {
  const Surface surface = some_surface(16);
  const SphericalHarmonics& transform = surface.harmonics();
  MeshEnergyDescent descent(damped);
  const VectorField a = tangential(surface, smooth_vector(surface.grid(), 9, 11));
  const VectorField b = tangential(surface, smooth_vector(surface.grid(), 9, 12));
  const auto check = [&](auto&& apply) {
    VectorField of_a, of_b;
    apply(a, of_a);
    apply(b, of_b);
    const double size = inner(surface.grid(), a, of_a);
    EXPECT_GT(size, 0);
    EXPECT_NEAR(inner(surface.grid(), a, of_b), inner(surface.grid(), of_a, b), 1e-12 * size);
  };
  check([&](const VectorField& field, VectorField& result) {
    descent.apply_second_derivative(transform, surface, field, result);
  });
  check(
      [&](const VectorField& field, VectorField& result) { descent.precondition(transform, surface, field, result); });
  // Of the energy itself, but for the damping: E is quadratic.
  VectorField product;
  descent.apply_second_derivative(transform, surface, a, product);
  const VectorField& x = surface.positions();
  const double second = energy_of(transform, x + a) - 2 * energy_of(transform, x) + energy_of(transform, x - a);
  EXPECT_NEAR(inner(surface.grid(), a, product), second + inner(surface.grid(), a, a), 1e-10 * second);
}

TEST(MeshEnergyDescent, RefusesAMetricThatIsNotPositive) {
  for (const MeshEnergyDescent::Metric& metric :
       {MeshEnergyDescent::Metric{}, MeshEnergyDescent::Metric{.lowest_degree = 1},
        MeshEnergyDescent::Metric{.lowest_degree = 2, .damping = -1}, MeshEnergyDescent::Metric{.damping = INFINITY}})
    EXPECT_THROW(MeshEnergyDescent{metric}, std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle::mesh_energy_test
