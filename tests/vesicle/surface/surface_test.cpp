// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/surface.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/bending.h"

namespace vesiflow::vesicle::surface_test {
namespace {

using std::numbers::pi;
using testing::EllipsoidPoint;

/// Round-off grows like N^2 (second derivatives): measured 1.8e-14, 9e-14, 4e-13, 2e-12 for N = 16 .. 128.
TEST(Surface, CurvaturesOfTheSphere) {
  for (int latitudes : {16, 31, 32, 64, 128}) {
    Surface surface(latitudes);
    surface.update(sphere(surface.grid()));
    const double tolerance = 2e-13 * std::max(1.0, std::pow(latitudes / 32.0, 2));
    EXPECT_LT((surface.mean_curvature() - 1).abs().maxCoeff(), tolerance) << latitudes;
    EXPECT_LT((surface.gaussian_curvature() - 1).abs().maxCoeff(), 2 * tolerance) << latitudes;
    EXPECT_LT((surface.normal() - surface.positions()).abs().maxCoeff(), 1e-13) << latitudes;
    EXPECT_NEAR(surface.area(), 4 * pi, 1e-12);
    EXPECT_NEAR(surface.volume(), 4 * pi / 3, 1e-12);
  }
}

TEST(Surface, CurvaturesOfTheEllipsoid) {
  const Vector3 semi_axes(1, 2, 4);
  for (int latitudes : {16, 32, 64}) {
    Surface surface(latitudes);
    surface.update(ellipsoid(surface.grid(), semi_axes, {.effective_radius = 2}));
    for (Eigen::Index k = 0; k < surface.grid().size(); ++k) {
      const EllipsoidPoint exact(semi_axes, surface.positions().row(k).matrix().transpose());
      ASSERT_NEAR(surface.mean_curvature()[k], exact.mean_curvature, 2e-12);
      ASSERT_NEAR(surface.gaussian_curvature()[k], exact.gaussian_curvature, 4e-12);
    }
  }
}

struct ReferenceShape {
  const char* name;
  Vector3 proportions;
  double area, energy;
};

/// Reference values for V = 4 pi / 3 by adaptive quadrature of the closed forms.
TEST(Surface, AreasVolumesAndEnergiesOfSpheroids) {
  const ReferenceShape shapes[] = {
      {"oblate 3:3:1", {3, 3, 1}, 15.784643699771735, 13.416289362616853},
      {"prolate 1:1:2.8", {1, 1, 2.8}, 14.593231123051272, 9.475609730348141},
      {"oblate 3:3:2.5", {3, 3, 2.5}, 12.642819734537799, 6.4013180614366325},
      {"oblate 3:3:1.7", {3, 3, 1.7}, 13.355633156995223, 7.64198530382741},
      {"oblate 3:3:2.2", {3, 3, 2.2}, 12.792174938515627, 6.642333883612886},
  };
  for (const ReferenceShape& shape : shapes) {
    Surface surface(64);
    surface.update(ellipsoid(surface.grid(), shape.proportions));
    EXPECT_NEAR(surface.area(), shape.area, 1e-12 * shape.area) << shape.name;
    EXPECT_NEAR(surface.volume(), 4 * pi / 3, 1e-12) << shape.name;
    EXPECT_NEAR(bending_energy(surface), shape.energy, 1e-10 * shape.energy) << shape.name;
  }
}

TEST(Surface, AreaAndVolumeConvergeSpectrally) {
  double previous = 1;
  for (int latitudes : {8, 16, 32}) {
    Surface surface(latitudes);
    surface.update(ellipsoid(surface.grid(), {1, 2, 4}, {.effective_radius = 2}));
    const double error = std::abs(surface.area() / 63.47664865246047 - 1);
    EXPECT_LT(error, std::max(previous / 20, 1e-14));
    EXPECT_NEAR(surface.volume(), 33.510321638291124, 1e-12 * 33.5);
    previous = error;
  }
}

TEST(Surface, Y32SurfaceAgainstReference) {
  Surface surface(96);
  surface.update(testing::y32_surface(surface.grid()));
  EXPECT_NEAR(surface.area(), 100.27093884255581, 1e-10);
  EXPECT_NEAR(surface.volume(), 59.73970978443227, 1e-10);
  EXPECT_NEAR(bending_energy(surface), 16.772145539051625, 1e-10);
  EXPECT_NEAR(surface.integral(surface.gaussian_curvature()), 4 * pi, 1e-9);
}

TEST(Surface, GaussBonnetAndClosedness) {
  Surface surface(48);
  VectorField x = prolate(surface.grid(), 0.8);
  x += 0.03 * testing::smooth_vector(surface.grid(), 5, 11);
  surface.update(x);
  EXPECT_NEAR(surface.integral(surface.gaussian_curvature()), 4 * pi, 1e-7);
  EXPECT_LT(surface.integral(surface.normal()).norm(), 1e-12);
  // int 2 H n dA = 0 and int H X.n dA = A.
  EXPECT_LT(surface.integral(VectorField(surface.normal().colwise() * surface.mean_curvature())).norm(), 1e-9);
  const VectorField pressed = surface.normal().colwise() * surface.mean_curvature();
  EXPECT_NEAR(testing::work(surface, pressed, x), surface.area(), 1e-9);
}

TEST(Surface, GradientAndDivergenceOfCartesianFunctions) {
  Surface surface(40);
  surface.update(ellipsoid(surface.grid(), {1, 1.3, 1.6}));
  const VectorField& x = surface.positions();
  const VectorField& n = surface.normal();
  // f = x z + y: grad_Gamma f = P (z, 1, x).
  VectorField gradient;
  surface.gradient(x.col(0) * x.col(2) + x.col(1), gradient);
  VectorField full(x.rows(), 3);
  full << x.col(2), ScalarField::Ones(x.rows()), x.col(0);
  const ScalarField normal_part = (full * n).rowwise().sum();
  EXPECT_LT((gradient - full + n.colwise() * normal_part).abs().maxCoeff(), 1e-11);
  // div_Gamma X = 2, div_Gamma n = 2 H.
  ScalarField divergence;
  surface.divergence(x, divergence);
  EXPECT_LT((divergence - 2).abs().maxCoeff(), 1e-11);
  EXPECT_NEAR(surface.max_divergence(x), 2, 1e-11);
  surface.divergence(n, divergence);
  EXPECT_LT((divergence - 2 * surface.mean_curvature()).abs().maxCoeff(), 1e-8);
}

/// div(s P) = grad s - 2 s H n, the two forms of Eq. (20).
TEST(Surface, ProjectorDivergenceEqualsTheNonDivergenceForm) {
  Surface surface(48);
  surface.update(ellipsoid(surface.grid(), {1, 1.2, 1.5}));
  const ScalarField s = testing::smooth_scalar(surface.grid(), 4, 12);
  VectorField divergence_form, gradient;
  surface.projector_divergence(s, divergence_form);
  surface.gradient(s, gradient);
  const VectorField other = gradient - surface.normal().colwise() * (2 * s * surface.mean_curvature());
  EXPECT_LT((divergence_form - other).abs().maxCoeff(), 1e-9);
}

TEST(Surface, RefusesBadPositions) {
  Surface surface(8);
  VectorField x = sphere(surface.grid());
  EXPECT_THROW(surface.update(x.topRows(5)), std::invalid_argument);
  VectorField broken = x;
  broken(17, 1) = std::numeric_limits<double>::quiet_NaN();
  try {
    surface.update(broken);
    FAIL();
  } catch (const std::domain_error& error) {
    EXPECT_NE(std::string(error.what()).find("marker 17"), std::string::npos) << error.what();
  }
  VectorField line = x;
  line.leftCols(2).setZero();
  EXPECT_THROW(surface.update(line), std::domain_error);
  EXPECT_THROW(surface.update(VectorField::Zero(x.rows(), 3)), std::domain_error);
}

TEST(Surface, ARefusedMeshLeavesNothingStale) {
  Surface surface(8), fresh(8);
  const VectorField x = ellipsoid(surface.grid(), {1, 1.3, 1.7}), y = prolate(surface.grid(), 0.8);
  surface.update(x, GeometryDetail::curvature);
  VectorField broken = x;
  broken(3, 0) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(surface.update(broken), std::domain_error);
  EXPECT_TRUE((surface.positions() == x).all());  // looked at before anything is changed
  EXPECT_THROW(surface.update(VectorField::Zero(x.rows(), 3), GeometryDetail::curvature), std::domain_error);
  EXPECT_FALSE(surface.geometry().has_curvature());
  EXPECT_TRUE(std::isnan(surface.area()));
  EXPECT_TRUE(std::isnan(surface.volume()));
  surface.update(y);
  fresh.update(y, GeometryDetail::curvature);
  EXPECT_EQ(surface.area(), fresh.area());
  EXPECT_TRUE((surface.mean_curvature() == fresh.mean_curvature()).all());
}

TEST(Surface, RefusesNumbersOfLatitudesBeyondItsRange) {
  for (int latitudes : {3, 513, 100000}) EXPECT_THROW(Surface{latitudes}, std::invalid_argument) << latitudes;
}

}  // namespace
}  // namespace vesiflow::vesicle::surface_test
