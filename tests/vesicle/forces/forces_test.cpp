// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/area.h"
#include "vesicle/bending.h"
#include "vesicle/tension.h"
#include "vesicle/volume.h"

namespace vesiflow::vesicle::forces_test {
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

class BendingForms : public Forces, public ::testing::WithParamInterface<std::pair<double, LaplacianForm>> {};

TEST_P(BendingForms, AreMinusTheGradientOfTheirEnergy) {
  const auto [spontaneous_curvature, form] = GetParam();
  BendingForce bending(surface.grid(), {.capillary_number = 2.5,
                                        .spontaneous_curvature = spontaneous_curvature,
                                        .laplacian = {form, Upsampling::twice, false}});
  bending.add_to(surface, force);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return bending.energy(s);
      },
      1e-6);
  expect_balanced(1e-7);
}

INSTANTIATE_TEST_SUITE_P(Forces, BendingForms,
                         ::testing::Values(std::pair{0.0, LaplacianForm::cartesian},
                                           std::pair{0.0, LaplacianForm::christoffel},
                                           std::pair{0.7, LaplacianForm::cartesian},
                                           std::pair{-1.3, LaplacianForm::cartesian}));

TEST_F(Forces, BendingWithoutSpontaneousCurvatureIsScaleFree) {
  BendingForce(surface.grid(), {}).add_to(surface, force);
  const double scale = surface.integral(ScalarField(force.matrix().rowwise().norm().array()));
  EXPECT_LT(std::abs(work(surface, force, shape)), 1e-7 * scale);
}

/// E = (1/2) int (H - H0)^2 changes under x -> (1 + s) x as H -> H/(1 + s), dA -> (1 + s)^2 dA: dE/ds = int (H0^2 - H0 H) dA.
TEST_F(Forces, WorkOfASpontaneousCurvatureUnderScaling) {
  constexpr double h0 = 0.7;
  BendingForce(surface.grid(), {.capillary_number = 1, .spontaneous_curvature = h0, .laplacian = {}})
      .add_to(surface, force);
  const double slope = surface.integral(ScalarField(h0 * h0 - h0 * surface.mean_curvature()));
  EXPECT_NEAR(-work(surface, force, shape), slope, 1e-8 * std::abs(slope));
}

TEST(Bending, EnergyOfASphereIsTwoPi) {
  Surface surface(24);
  surface.update(sphere(surface.grid(), {.effective_radius = 3, .centre = {1, -2, 5}}));
  EXPECT_NEAR(bending_energy(surface), 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(bending_energy(surface, 1.0 / 3), 0, 1e-12);
}

struct TensionCase {
  TensionLaw law;
  TensionForm form;
};

class Tensions : public Forces, public ::testing::WithParamInterface<TensionCase> {
 protected:
  Tensions()
      : tension({.sigma0 = 600, .law = GetParam().law, .form = GetParam().form}),
        target(surface.area_weight() * (0.1 * testing::smooth_scalar(surface.grid(), 4, 41)).exp()) {}

  TensionForce tension;
  ScalarField target;
  ScalarField sigma;
};

TEST_P(Tensions, AreMinusTheGradientOfTheirEnergy) {
  tension.evaluate(surface, target, sigma);
  tension.add_to(surface, sigma, force);
  expect_balanced(1e-9);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return tension.energy(s, target);
      },
      1e-6);
}

/// Work of the tension under x -> (1 + s) x: -int F . x dA = 2 int sigma dA.
TEST_P(Tensions, WorkUnderScaling) {
  tension.evaluate(surface, target, sigma);
  tension.add_to(surface, sigma, force);
  const double expected = 2 * surface.integral(sigma);
  EXPECT_NEAR(-work(surface, force, shape), expected, 1e-9 * std::abs(expected));
}

TEST_P(Tensions, OfAUniformStretch) {
  // On a sphere of twice the target area sigma = sigma0 ln(2) / 2 or sigma0, and F = -2 sigma n.
  const VectorField x = sphere(surface.grid());
  surface.update(x);
  tension.evaluate(surface, surface.area_weight() / 2, sigma);
  const double expected = GetParam().law == TensionLaw::logarithmic ? 300 * std::log(2.0) : 600;
  EXPECT_LT((sigma - expected).abs().maxCoeff(), 1e-10);
  tension.add_to(surface, sigma, force);
  EXPECT_LT((force + 2 * expected * x).abs().maxCoeff(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Forces, Tensions,
                         ::testing::Values(TensionCase{TensionLaw::logarithmic, TensionForm::divergence},
                                           TensionCase{TensionLaw::logarithmic, TensionForm::non_divergence},
                                           TensionCase{TensionLaw::linear, TensionForm::divergence},
                                           TensionCase{TensionLaw::linear, TensionForm::non_divergence}));

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

TEST_F(Forces, AreaPenaltyIsMinusTheGradientOfItsEnergy) {
  const double target = 0.9 * surface.area();
  add_area_penalty(surface, 1e3, target, force);
  expect_balanced(1e-10);
  expect_minus_gradient(
      [&](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return area_penalty_energy(s, 1e3, target);
      },
      1e-6);
}

TEST_F(Forces, RefuseBadArguments) {
  const SphereGrid grid(8);
  EXPECT_THROW(BendingForce(grid, {.capillary_number = 0, .laplacian = {}}), std::invalid_argument);
  EXPECT_THROW(BendingForce(grid, {.spontaneous_curvature = std::nan(""), .laplacian = {}}), std::invalid_argument);
  EXPECT_THROW(TensionForce({.sigma0 = -1}), std::invalid_argument);
  EXPECT_THROW(TensionForce({.sigma0 = std::nan("")}), std::invalid_argument);
  EXPECT_THROW(add_volume_penalty(surface, 1, 0, force), std::invalid_argument);
  EXPECT_THROW(add_area_penalty(surface, 1, 0, force), std::invalid_argument);
  for (const double wrong : {-1.0, std::nan(""), double{INFINITY}}) {
    EXPECT_THROW(add_volume_penalty(surface, wrong, 1, force), std::invalid_argument);
    EXPECT_THROW(add_area_penalty(surface, wrong, 1, force), std::invalid_argument);
    EXPECT_THROW(volume_penalty_energy(surface, 1, wrong), std::invalid_argument);
    EXPECT_THROW(area_penalty_energy(surface, 1, wrong), std::invalid_argument);
  }
  ScalarField sigma;
  EXPECT_THROW(TensionForce({.sigma0 = 1}).evaluate(surface, ScalarField::Ones(3), sigma), std::invalid_argument);
  EXPECT_THROW(bending_energy(surface, std::nan("")), std::invalid_argument);
  for (const double wrong : {0.0, -1.0, std::nan(""), double{INFINITY}}) {
    ScalarField target = surface.area_weight();
    target[11] = wrong;
    EXPECT_THROW(TensionForce({.sigma0 = 1}).evaluate(surface, target, sigma), std::invalid_argument);
    EXPECT_THROW(TensionForce({.sigma0 = 1}).energy(surface, target), std::invalid_argument);
  }
}

TEST_F(Forces, RefuseATensionThatIsNotFinite) {
  for (const TensionForm form : {TensionForm::divergence, TensionForm::non_divergence}) {
    TensionForce tension_force({.sigma0 = 1, .form = form});
    const VectorField before = force;
    testing::expect_refused_if_not_finite(
        surface.area_weight(), [&](const ScalarField& tension) { tension_force.add_to(surface, tension, force); });
    EXPECT_THROW(tension_force.add_to(surface, ScalarField::Ones(3), force), std::invalid_argument);
    EXPECT_TRUE((force == before).all());
    // Finite, though their sum is not: what is large is not refused.
    EXPECT_NO_THROW(tension_force.add_to(surface, ScalarField::Constant(force.rows(), 1e306), force));
    force = before;
  }
}

TEST_F(Forces, AreaRateRefusesAVelocityThatIsNotFinite) {
  testing::expect_refused_if_not_finite(surface.normal(), [&](const VectorField& u) { area_rate(surface, u); });
}

}  // namespace
}  // namespace vesiflow::vesicle::forces_test
