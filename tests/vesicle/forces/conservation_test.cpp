// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/conservation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/area.h"

namespace vesiflow::vesicle::conservation_test {
namespace {

using testing::smooth_vector;

constexpr int latitudes = 24;

class Conservation : public ::testing::Test {
 protected:
  Conservation() : surface(latitudes), motion(0.05 * smooth_vector(surface.grid(), 6, 61)) {
    surface.update(ellipsoid(surface.grid(), {1, 1.3, 1.7}));
  }

  Surface moved(double dt) const {
    Surface result(latitudes);
    result.update(surface.positions() + dt * motion);
    return result;
  }

  Surface surface;
  VectorField motion;
};

/// area_rate against differences of the area itself.
TEST_F(Conservation, AreaRateIsTheDerivativeOfTheArea) {
  const double rate = testing::directional_derivative(
      [](const VectorField& x) {
        Surface s(latitudes);
        s.update(x);
        return s.area();
      },
      surface.positions(), motion, 1e-2);
  EXPECT_NEAR(area_rate(surface, motion), rate, 1e-8 * std::abs(rate));
}

TEST_F(Conservation, CorrectedVelocityRestoresToSecondOrder) {
  const Conserved target{1.001 * surface.volume(), 1.002 * surface.area()};
  const VectorField velocity = motion;
  double errors[2][2];
  for (int k : {0, 1}) {
    const double dt = k == 0 ? 0.1 : 0.05;
    motion = velocity;
    ConservationProjection projection(surface.grid(), {*target.volume, *target.area});
    projection.correct_velocity(surface, dt, motion);
    EXPECT_NEAR(surface.flux(motion) * dt, *target.volume - surface.volume(), 1e-13);
    EXPECT_NEAR(area_rate(surface, motion) * dt, *target.area - surface.area(), 1e-12);
    // Starting on the target the miss is of second order in dt.
    motion = velocity;
    ConservationProjection(surface.grid(), {surface.volume(), surface.area()}).correct_velocity(surface, dt, motion);
    const Surface after = moved(dt);
    errors[k][0] = std::abs(after.volume() - surface.volume());
    errors[k][1] = std::abs(after.area() - surface.area());
  }
  EXPECT_NEAR(errors[0][0] / errors[1][0], 4, 0.2);
  EXPECT_NEAR(errors[0][1] / errors[1][1], 4, 0.2);
}

TEST_F(Conservation, CorrectedDisplacementIsExact) {
  for (const Conserved& target :
       {Conserved{1.01 * surface.volume(), std::nullopt}, Conserved{std::nullopt, 1.01 * surface.area()},
        Conserved{surface.volume(), surface.area()}, Conserved{}}) {
    VectorField displacement = motion;
    ConservationProjection(surface.grid(), target).correct_displacement(surface, displacement);
    Surface after(latitudes);
    after.update(surface.positions() + displacement);
    if (target.volume) {
      EXPECT_NEAR(after.volume() / *target.volume, 1, 2e-13);
    }
    if (target.area) {
      EXPECT_NEAR(after.area() / *target.area, 1, 2e-13);
    }
    if (!target.volume && !target.area) {
      EXPECT_TRUE((displacement == motion).all());
    }
  }
}

/// The correction is along the normal and so leaves tangential motions alone.
TEST_F(Conservation, CorrectionIsAlongTheNormal) {
  VectorField corrected = motion;
  ConservationProjection(surface.grid(), {surface.volume(), surface.area()}).correct_velocity(surface, 0.1, corrected);
  const VectorField change = corrected - motion;
  const ScalarField normal = (change * surface.normal()).rowwise().sum();
  EXPECT_GT(normal.abs().maxCoeff(), 1e-4);
  for (int component = 0; component < 3; ++component)
    EXPECT_LT((change.col(component) - normal * surface.normal().col(component)).abs().maxCoeff(), 1e-15);
}

/// Noise of the markers must not be fed back: the correction holds the degrees of the shape below 10, and those of its normal.
TEST_F(Conservation, CorrectionDoesNotAmplifyNoise) {
  VectorField noisy = surface.positions();
  const SphereGrid& grid = surface.grid();
  Coefficients coefficients(latitudes, 1);
  coefficients.set_zero();
  coefficients(0, 20, 7) = 1e-4;
  ScalarField noise(grid.size());
  SphericalHarmonics(latitudes, grid).synthesis(coefficients, noise);
  for (int component = 0; component < 3; ++component) noisy.col(component) += noise * surface.normal().col(component);
  const auto correction = [&](const VectorField& positions) {
    surface.update(positions);
    VectorField displacement = VectorField::Zero(grid.size(), 3);
    ConservationProjection(grid, {surface.volume(), 1.001 * surface.area()})
        .correct_displacement(surface, displacement);
    return ScalarField((displacement * surface.normal()).rowwise().sum());
  };
  const VectorField smooth = surface.positions();
  const ScalarField change = correction(noisy) - correction(smooth);
  // H of the noise is 20^2/2 times the noise; a correction along it would hold that times b of about 1e-3.
  EXPECT_LT(change.abs().maxCoeff(), 0.02 * noise.abs().maxCoeff());
}

TEST_F(Conservation, SayWhyASphereCannotKeepBoth) {
  surface.update(sphere(surface.grid()));
  ConservationProjection both(surface.grid(), {surface.volume(), surface.area()});
  EXPECT_THROW(both.correct_velocity(surface, 0.1, motion), std::domain_error);
  ConservationProjection volume(surface.grid(), {surface.volume(), std::nullopt});
  EXPECT_NO_THROW(volume.correct_velocity(surface, 0.1, motion));
}

/// With smooth directions volume and area come out as exactly, and what is added has few degrees and is still along the normal as
/// far as those tell.
TEST_F(Conservation, SmoothedDisplacementIsExactAndOfFewDegrees) {
  constexpr int degrees = 5;
  for (const Conserved& target :
       {Conserved{1.005 * surface.volume(), std::nullopt}, Conserved{std::nullopt, 1.005 * surface.area()},
        Conserved{surface.volume(), surface.area()}}) {
    VectorField displacement = motion, plain = motion;
    ConservationProjection(surface.grid(), target, degrees).correct_displacement(surface, displacement);
    ConservationProjection(surface.grid(), target).correct_displacement(surface, plain);
    Surface after(latitudes);
    after.update(surface.positions() + displacement);
    if (target.volume) {
      EXPECT_NEAR(after.volume() / *target.volume, 1, 2e-13);
    }
    if (target.area) {
      EXPECT_NEAR(after.area() / *target.area, 1, 2e-13);
    }
    const auto high_degrees = [&](const VectorField& added) {
      Coefficients coefficients(latitudes, 3);
      SphericalHarmonics(latitudes, surface.grid()).analysis(added, coefficients);
      double largest = 0;
      for (int field = 0; field < 3; ++field)
        for (int n = degrees; n < latitudes; ++n)
          for (int m = 0; m <= n; ++m) largest = std::max(largest, std::abs(coefficients(field, n, m)));
      return largest / added.abs().maxCoeff();
    };
    EXPECT_LT(high_degrees(displacement - motion), 1e-12);
    EXPECT_GT(high_degrees(plain - motion), 1e-3);  // which is what smoothing is for
    const VectorField added = displacement - motion;
    const ScalarField normal = (added * surface.normal()).rowwise().sum();
    EXPECT_GT(surface.integral(ScalarField(normal.square())),
              0.9 * surface.integral(ScalarField(added.square().rowwise().sum())));
  }
}

/// For n and 2 H n cut to all degrees that a smooth shape has, the corrections are those without cutting but for F.
TEST_F(Conservation, SmoothingWithAllDegreesChangesNothingOfVolumes) {
  const Conserved target{1.005 * surface.volume(), std::nullopt};
  VectorField all = motion, plain = motion;
  ConservationProjection(surface.grid(), target, latitudes).correct_displacement(surface, all);
  ConservationProjection(surface.grid(), target).correct_displacement(surface, plain);
  // n has degrees beyond the grid's, falling like (b/c)^n from one to the next.
  EXPECT_LT((all - plain).abs().maxCoeff(), 1e-4 * (plain - motion).abs().maxCoeff());
}

/// 1 - (int H)^2 / (A int H^2) on a spheroid of axes 1, 1, c, by quadrature of the closed form of H over its generatrix.
TEST_F(Conservation, IndependenceIsTheVarianceOfTheCurvature) {
  Surface spheroid_surface(64);
  const double c = 2;
  spheroid_surface.update(spheroid(spheroid_surface.grid(), c));
  double area = 0, first = 0, second = 0;
  constexpr int points = 4000;
  for (int i = 0; i < points; ++i) {
    const double theta = (i + 0.5) * M_PI / points, s = std::sin(theta), co = std::cos(theta);
    const testing::EllipsoidPoint at({1, 1, c}, {s, 0, c * co});
    const double weight = s * std::hypot(co, c * s);
    area += weight;
    first += weight * at.mean_curvature;
    second += weight * at.mean_curvature * at.mean_curvature;
  }
  EXPECT_NEAR(ConservationProjection::independence(spheroid_surface), 1 - first * first / (area * second), 1e-6);
  EXPECT_GT(ConservationProjection::independence(spheroid_surface), 0.05);
  spheroid_surface.update(sphere(spheroid_surface.grid(), {.effective_radius = 0.7}));
  EXPECT_NEAR(ConservationProjection::independence(spheroid_surface), 0, 1e-13);
  // Of second order in the deviation from a sphere.
  const auto near_sphere = [&](double deviation) {
    spheroid_surface.update(spheroid(spheroid_surface.grid(), 1 + deviation));
    return ConservationProjection::independence(spheroid_surface);
  };
  EXPECT_NEAR(near_sphere(2e-3) / near_sphere(1e-3), 4, 0.02);
}

TEST_F(Conservation, RefusesBadArguments) {
  EXPECT_THROW(ConservationProjection(surface.grid(), {}, -1), std::invalid_argument);
  EXPECT_THROW(ConservationProjection(surface.grid(), {0.0, std::nullopt}), std::invalid_argument);
  EXPECT_THROW(ConservationProjection(surface.grid(), {1.0, std::nan("")}), std::invalid_argument);
  ConservationProjection projection(surface.grid(), {surface.volume(), std::nullopt});
  const VectorField before = motion;
  for (const double wrong : {0.0, -1.0, std::nan(""), double{INFINITY}})
    EXPECT_THROW(projection.correct_velocity(surface, wrong, motion), std::invalid_argument);
  ConservationProjection larger(surface.grid(), {2 * surface.volume(), std::nullopt});
  EXPECT_THROW(larger.correct_velocity(surface, 1e-320, motion), std::domain_error);
  EXPECT_TRUE((motion == before).all());
  VectorField short_field = VectorField::Zero(3, 3);
  EXPECT_THROW(projection.correct_velocity(surface, 1, short_field), std::invalid_argument);
  // Half the volume at the same area is no small correction; the sphere's area is the least.
  ConservationProjection impossible(surface.grid(), {surface.volume(), 0.5 * surface.area()});
  EXPECT_THROW(impossible.correct_displacement(surface, motion), std::domain_error);
}

TEST_F(Conservation, RefusesAMotionThatIsNotFinite) {
  for (const Conserved& conserved : {Conserved{surface.volume(), std::nullopt}, Conserved{std::nullopt, surface.area()},
                                     Conserved{surface.volume(), surface.area()}, Conserved{}}) {
    ConservationProjection projection(surface.grid(), conserved);
    testing::expect_refused_if_not_finite(motion,
                                          [&](VectorField& u) { projection.correct_velocity(surface, 0.1, u); });
    if (conserved.volume || conserved.area)
      testing::expect_refused_if_not_finite(motion,
                                            [&](VectorField& d) { projection.correct_displacement(surface, d); });
  }
}

/// Area and volume of a nearly spherical shape leave no room for a displacement that is larger than its deviation.
TEST(ConservationProjection, SaysWhenCorrectionsDiverge) {
  Surface surface(16);
  for (const double deviation : {1e-3, 1e-4}) {
    surface.update(ellipsoid(surface.grid(), {1, 1, 1 + deviation}));
    ConservationProjection projection(surface.grid(), {surface.volume(), surface.area()});
    VectorField displacement = 1e-3 * testing::smooth_vector(surface.grid(), 4, 9);
    try {
      projection.correct_displacement(surface, displacement);
      ADD_FAILURE();
    } catch (const std::domain_error& error) {
      EXPECT_NE(std::string(error.what()).find("volume and area"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace vesiflow::vesicle::conservation_test
