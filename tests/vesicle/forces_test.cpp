#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/bending.h"
#include "vesicle/tension.h"
#include "vesicle/volume.h"

namespace vesiflow::vesicle {
namespace {

using testing::cross;
using testing::directional_derivative;
using testing::smooth_vector;
using testing::work;

constexpr int latitudes = 48;

/// A smooth shape without symmetry.
VectorField test_shape(const SphereGrid& grid) {
  return ellipsoid(grid, {1, 1.2, 1.5}) + 0.03 * smooth_vector(grid, 4, 21);
}

class Forces : public ::testing::Test {
 protected:
  Forces() : surface(latitudes), shape(test_shape(surface.grid())), force(VectorField::Zero(shape.rows(), 3)) {
    surface.update(shape);
  }

  /// A force derived from an energy of shape alone has no resultant and no moment, and a scale-free one no
  /// virial.
  void expect_balanced(double tolerance) const {
    const double scale = surface.integral(ScalarField(force.matrix().rowwise().norm().array()));
    EXPECT_LT(surface.integral(force).norm(), tolerance * scale);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LT(std::abs(work(surface, force, cross(Vector3::Unit(axis), shape))), tolerance * scale);
  }

  template <class Energy>
  void expect_minus_gradient(const Energy& energy, double tolerance) const {
    for (unsigned seed : {31, 32, 33}) {
      const VectorField direction = smooth_vector(surface.grid(), 4, seed);
      const double slope = directional_derivative(energy, shape, direction, 1e-3);
      EXPECT_NEAR(-work(surface, force, direction), slope, tolerance * std::abs(slope));
    }
  }

  Surface surface;
  VectorField shape;
  VectorField force;
};

TEST_F(Forces, BendingIsMinusTheGradientOfItsEnergy) {
  BendingForce(latitudes, 2.5, LaplacianForm::cartesian).add_to(surface, force);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return bending_energy(s) / 2.5;
      },
      1e-6);
}

TEST_F(Forces, BendingIsBalancedAndScaleFree) {
  BendingForce(latitudes, 1, LaplacianForm::cartesian).add_to(surface, force);
  expect_balanced(1e-7);
  const double scale = surface.integral(ScalarField(force.matrix().rowwise().norm().array()));
  EXPECT_LT(std::abs(work(surface, force, shape)), 1e-7 * scale);
}

TEST(Bending, EnergyOfASphereIsTwoPi) {
  Surface surface(24);
  surface.update(sphere(surface.grid(), {.effective_radius = 3, .centre = {1, -2, 5}}));
  EXPECT_NEAR(bending_energy(surface), 2 * std::numbers::pi, 1e-12);
}

TEST_F(Forces, TensionIsMinusTheGradientOfItsEnergy) {
  const TensionForce tension(600);
  const ScalarField target = surface.area_weight() * (0.1 * testing::smooth_scalar(surface.grid(), 4, 41)).exp();
  ScalarField sigma;
  tension.evaluate(surface, target, sigma);
  TensionForce(600).add_to(surface, sigma, force);
  expect_balanced(1e-9);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return tension.energy(s, target);
      },
      1e-6);
}

TEST_F(Forces, TensionOfAUniformStretch) {
  // On a sphere of twice the target area sigma = sigma0 ln(2) / 2, and F = -2 sigma n.
  const VectorField x = sphere(surface.grid());
  surface.update(x);
  TensionForce tension(3);
  ScalarField sigma;
  tension.evaluate(surface, surface.area_weight() / 2, sigma);
  EXPECT_LT((sigma - 1.5 * std::log(2.0)).abs().maxCoeff(), 1e-13);
  tension.add_to(surface, sigma, force);
  EXPECT_LT((force + 3 * std::log(2.0) * x).abs().maxCoeff(), 1e-11);
}

TEST_F(Forces, VolumePenaltyIsMinusTheGradientOfItsEnergy) {
  const double target = 0.9 * surface.volume();
  add_volume_penalty(surface, 1e3, target, force);
  expect_balanced(1e-10);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return volume_penalty_energy(s, 1e3, target);
      },
      1e-6);
}

TEST_F(Forces, VolumeProjectionSetsTheFlux) {
  VectorField velocity = smooth_vector(surface.grid(), 8, 51);
  const double target = 1.01 * surface.volume();
  project_volume_rate(surface, target, 0.125, velocity);
  EXPECT_NEAR(surface.flux(velocity), -(surface.volume() - target) / 0.125, 1e-13);
}

TEST_F(Forces, RefuseBadArguments) {
  EXPECT_THROW(BendingForce(8, 0, LaplacianForm::cartesian), std::invalid_argument);
  EXPECT_THROW(TensionForce(-1), std::invalid_argument);
  EXPECT_THROW(TensionForce(std::nan("")), std::invalid_argument);
  EXPECT_THROW(add_volume_penalty(surface, 1, 0, force), std::invalid_argument);
  EXPECT_THROW(project_volume_rate(surface, 1, 0, force), std::invalid_argument);
  ScalarField sigma;
  EXPECT_THROW(TensionForce(1).evaluate(surface, ScalarField::Ones(3), sigma), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::vesicle
