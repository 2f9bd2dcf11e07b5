// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/shape_conservation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/constants.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling::shape_conservation_test {
namespace {

constexpr int latitudes = 16;

vesicle::Membrane membrane(double reduced_volume) {
  return {vesicle::prolate(vesicle::SphereGrid(latitudes), reduced_volume), latitudes, {}};
}

ShapeConservation::Parameters parameters(const vesicle::Membrane& of) {
  const double v = vesicle::reduced_volume(of.initial_area(), of.initial_volume());
  return {.radius = std::sqrt(of.initial_area() / (4.0 * std::numbers::pi)),
          .excess_area = std::max(0.0, 1.0 / std::cbrt(v * v) - 1.0)};
}

/// Longer along z by that share, and thinner.
vesicle::VectorField stretch(const vesicle::Membrane& of, double share) {
  vesicle::VectorField displacement = of.positions();
  for (int axis = 0; axis < 3; ++axis) displacement.col(axis) *= axis == 2 ? share : -0.3 * share;
  return displacement;
}

TEST(ShapeConservation, AreaAndVolumeOfAStepAreThoseOfTheStart) {
  vesicle::Membrane m = membrane(0.9);
  ShapeConservation conservation(parameters(m), m);
  conservation.begin_step(0.01, m);
  ASSERT_TRUE(conservation.keeps_area());
  vesicle::VectorField displacement = stretch(m, 0.02);
  conservation.correct(m.surface(), displacement);
  vesicle::Surface moved(m.surface().grid());
  moved.update(m.positions() + displacement);
  EXPECT_NEAR(moved.area(), m.initial_area(), 1e-12 * m.initial_area());
  EXPECT_NEAR(moved.volume(), m.initial_volume(), 1e-12 * m.initial_volume());

  vesicle::VectorField velocity = stretch(m, 1.0);
  conservation.remove_rates(m.surface(), velocity);
  EXPECT_NEAR(m.surface().flux(velocity), 0.0, 1e-12);
  EXPECT_NEAR(m.surface().integral(vesicle::ScalarField(m.surface().mean_curvature() *
                                                        (velocity * m.surface().normal()).rowwise().sum())),
              0.0, 1e-12);
  EXPECT_EQ(conservation.entries(), 2);
}

TEST(ShapeConservation, WithoutAnythingToKeepMotionsStayAsTheyAre) {
  const vesicle::Membrane m = membrane(0.9);
  ShapeConservation::Parameters none = parameters(m);
  none.keeps_volume = none.keeps_area = false;
  ShapeConservation conservation(none, m);
  conservation.begin_step(0.01, m);
  EXPECT_FALSE(conservation.keeps_something());
  vesicle::VectorField displacement = stretch(m, 0.02);
  const vesicle::VectorField before = displacement;
  conservation.correct(m.surface(), displacement);
  conservation.remove_rates(m.surface(), displacement);
  EXPECT_TRUE((displacement == before).all());
  EXPECT_EQ(conservation.entries(), 0);
}

// A sphere has no other shape of its area and volume.
TEST(ShapeConservation, OfASphereOnlyTheVolumeIsKept) {
  const vesicle::Membrane m = membrane(1.0);
  ShapeConservation conservation(parameters(m), m);
  conservation.begin_step(0.01, m);
  EXPECT_FALSE(conservation.keeps_area());
  vesicle::VectorField displacement = stretch(m, 0.02);
  conservation.correct(m.surface(), displacement);
  vesicle::Surface moved(m.surface().grid());
  moved.update(m.positions() + displacement);
  EXPECT_NEAR(moved.volume(), m.initial_volume(), 1e-12 * m.initial_volume());
  EXPECT_GT(moved.area(), (1.0 + 1e-6) * m.initial_area());
}

// The flow moves a sphere by 0.28 of its radius in unit time, and a shape of excess area e deviates by (e/2)^(1/2).
TEST(ShapeConservation, TheAreaGivesWayToAFlowThatIsFasterThanTheShapeIsDeformed) {
  const vesicle::Membrane m = membrane(0.99);
  ShapeConservation::Parameters in_flow = parameters(m);
  in_flow.strain_rate = 1.0;
  ShapeConservation conservation(in_flow, m);
  const double longest = std::sqrt(0.5 * in_flow.excess_area) / constants::normal_share_of_shear;
  conservation.begin_step(0.99 * longest, m);
  EXPECT_TRUE(conservation.keeps_area());
  conservation.begin_step(1.01 * longest, m);
  EXPECT_FALSE(conservation.keeps_area());
}

// And a correction that is larger than the deviation is none: it would make another shape.
TEST(ShapeConservation, TheAreaGivesWayToADisplacementThatMakesAnotherShape) {
  const vesicle::Membrane m = membrane(0.9999);
  ShapeConservation conservation(parameters(m), m);
  conservation.begin_step(1e-6, m);
  ASSERT_TRUE(conservation.keeps_area());
  vesicle::VectorField displacement = stretch(m, 0.2);
  conservation.correct(m.surface(), displacement);
  EXPECT_FALSE(conservation.keeps_area());
}

TEST(MeanStrain, IsThatOfTheUnstrainedArea) {
  vesicle::Membrane m = membrane(0.9);
  m.move_to(vesicle::VectorField(1.1 * m.positions()), vesicle::ScalarField::Constant(m.positions().rows(), 0.07));
  EXPECT_NEAR(MeanStrain::of(m), 0.07, 1e-14);
  const MeanStrain strain(0.01);
  EXPECT_FALSE(strain.is_held(m));
  // 2 ln 1.1 of the area, and 0.04 that is held.
  EXPECT_NEAR(strain.missing(m), 2.0 * std::log(1.1) + 0.04 - 0.07, 1e-12);
  m.move_to(m.positions(), vesicle::ScalarField::Constant(m.positions().rows(), 0.3));
  EXPECT_NEAR(strain.missing(m), 2.0 * std::log(1.1) + 0.04 - 0.3, 1e-12);
}

// What is held is continuous in the mean strain, at most the limit, and of the sign of the area's where both are known.
TEST(MeanStrain, WhatIsHeldIsBoundedAndHasASide) {
  const double most = 0.1;
  for (const double of_area : {-0.3, -0.02, 0.02, 0.3})
    for (double mean = -0.5; mean <= 0.5; mean += 0.01) {
      const double held = MeanStrain::held(mean, of_area, most);
      EXPECT_LE(std::abs(held), most);
      if (std::abs(mean) <= most) {
        EXPECT_GE(held * of_area, 0.0) << mean << ' ' << of_area;
      }
    }
  EXPECT_EQ(MeanStrain::held(0.05, 0.0, most), 0.0);
  EXPECT_DOUBLE_EQ(MeanStrain::held(0.05, 0.02, most), 0.03);
  EXPECT_EQ(MeanStrain::held(0.5, 0.02, most), most);
  EXPECT_EQ(MeanStrain::held(-0.5, 0.02, most), -most);
  EXPECT_EQ(MeanStrain::held(-0.5, 0.3, most), most);
}

}  // namespace
}  // namespace vesiflow::coupling::shape_conservation_test
