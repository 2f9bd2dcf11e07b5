// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/spectrum.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/upsampling.h"

namespace vesiflow::vesicle::spectrum_test {
namespace {

/// Amplitude 3 exp(-rate n) in every `stride`-th degree.
Coefficients decaying(int degrees, double rate, int stride) {
  Coefficients coefficients(degrees, 1);
  coefficients.set_zero();
  for (int n = 0; n < degrees; n += stride) coefficients(0, n, n / 2) = 3 * std::exp(-rate * n) / (n < 2 ? 1 : M_SQRT2);
  return coefficients;
}

TEST(Spectrum, AmplitudesAreTheEnergyPerDegree) {
  const Coefficients coefficients = testing::random_coefficients(12, 3, 5);
  const Spectrum spectrum(coefficients);
  double sum = 0;
  for (const double a : spectrum.amplitude()) sum += a * a;
  EXPECT_EQ(spectrum.degrees(), 12);
  EXPECT_NEAR(sum, coefficients.energy(0, 12), 1e-12 * sum);
  EXPECT_DOUBLE_EQ(std::pow(spectrum.amplitude()[7], 2), coefficients.energy(7, 8));
}

TEST(Spectrum, FindsTheRateOfAGeometricDecay) {
  for (const double rate : {0.1, 0.3, 0.9}) {
    const Spectrum all(decaying(24, rate, 1));
    EXPECT_NEAR(all.decay_rate(), rate, 1e-12);
    EXPECT_NEAR(all.extrapolated(40), 3 * std::exp(-rate * 39), 1e-9 * std::exp(-rate * 39));  // the larger neighbour
    EXPECT_NEAR(Spectrum(decaying(24, rate, 2)).decay_rate(), rate, 0.05 * rate);
  }
}

TEST(Spectrum, NoiseDoesNotDecay) {
  Coefficients noise(24, 1);
  noise.set_zero();
  for (int n = 0; n < 24; ++n) noise(0, n, 0) = n < 2 ? 1 : 1e-3;
  const Spectrum spectrum(noise);
  EXPECT_NEAR(spectrum.decay_rate(), 0, 1e-12);
  EXPECT_GT(spectrum.laplacian_tail(500), 1);
}

TEST(Spectrum, RoundOffDoesNotCountAsATail) {
  Coefficients coefficients = decaying(64, 1.5, 1);
  for (int n = 0; n < 64; ++n) coefficients(0, n, 0) += 1e-15;
  EXPECT_LT(Spectrum(coefficients).laplacian_tail(64), 1e-8);
}

/// The prediction from a coarse mesh is what a finer one finds.
TEST(Resolution, PredictsWhatAFinerMeshFinds) {
  for (const Vector3& axes : {Vector3(1, 2, 4), Vector3(3, 3, 1)}) {
    Surface coarse(24);
    coarse.update(ellipsoid(coarse.grid(), axes));
    const Resolution predicted = resolution(coarse, 0.01);
    ASSERT_FALSE(predicted.sufficient());
    ASSERT_GT(predicted.needed_latitudes, 24);

    // The share of Lap H beyond N degrees, measured on a mesh that resolves it.
    Surface fine(96);
    fine.update(ellipsoid(fine.grid(), axes));
    const Spectrum exact = mean_curvature_spectrum(fine);
    const auto share = [&](int degrees) {
      double tail = 0, all = 0;
      for (int n = 0; n < 96; ++n) {
        const double a = exact.amplitude()[n];
        if (n >= degrees) tail += std::pow(n * (n + 1) * a, 2);
        all += std::pow((1 + n * (n + 1)) * a, 2);
      }
      return std::sqrt(tail / all);
    };
    EXPECT_GT(predicted.unresolved, share(24) / 3);
    EXPECT_LT(predicted.unresolved, share(24) * 3);
    EXPECT_LT(share(predicted.needed_latitudes), 2 * predicted.tolerance);
    EXPECT_GT(share(predicted.needed_latitudes - 16), predicted.tolerance / 2);
  }
}

TEST(Resolution, WarnsInWordsAUserUnderstands) {
  Surface surface(24);
  surface.update(ellipsoid(surface.grid(), {1, 2, 4}));
  const std::string warning = resolution_warning(resolution(surface, 0.01));
  EXPECT_NE(warning.find("the shape needs N_theta >= 40 (it has 24)"), std::string::npos) << warning;
  surface.update(prolate(surface.grid(), 0.95));
  EXPECT_EQ(resolution_warning(resolution(surface)), "");
  EXPECT_THROW(resolution(surface, 0), std::invalid_argument);
}

TEST(Upsampling, FactorsAndLatitudes) {
  EXPECT_EQ(upsampled_latitudes(33, Upsampling::none), 33);
  EXPECT_EQ(upsampled_latitudes(33, Upsampling::three_halves), 50);
  EXPECT_EQ(upsampled_latitudes(33, Upsampling::twice), 66);
  EXPECT_THROW(factor(Upsampling::automatic), std::invalid_argument);
  EXPECT_THROW(choose_upsampling(Spectrum(decaying(24, 1, 1)), 0), std::invalid_argument);
}

TEST(Upsampling, FollowsTheDecay) {
  EXPECT_EQ(choose_upsampling(Spectrum(decaying(32, 1.0, 1))), Upsampling::none);
  EXPECT_EQ(choose_upsampling(Spectrum(decaying(32, 0.55, 1))), Upsampling::three_halves);
  EXPECT_EQ(choose_upsampling(Spectrum(decaying(32, 0.2, 1))), Upsampling::twice);
}

/// sum_{n >= d} of the fitted law, term by term. For slow decay its largest terms lie far beyond the first.
TEST(Spectrum, TheTailIsTheSumOfTheLaw) {
  for (const double rate : {0.03, 0.3, 2.0}) {
    const Spectrum spectrum(decaying(24, rate, 1));
    double scale = 0;
    for (int n = 0; n < 24; ++n) scale += std::pow((1 + n * (n + 1)) * spectrum.amplitude()[n], 2);
    for (const int degrees : {8, 24, 100}) {
      double sum = 0;
      for (double n = degrees; n < 3000; ++n) sum += std::pow(n * (n + 1) * spectrum.extrapolated(n), 2);
      const double tail = std::sqrt(sum / scale);
      EXPECT_NEAR(spectrum.laplacian_tail(degrees), tail, 1e-10 * tail) << rate << ' ' << degrees;
    }
  }
}

TEST(Spectrum, OfNothingHasNoTailAndOfNaNIsRefused) {
  Coefficients zero(8, 1);
  zero.set_zero();
  EXPECT_EQ(Spectrum(zero).laplacian_tail(8), 0);
  EXPECT_EQ(choose_upsampling(Spectrum(zero)), Upsampling::none);
  zero(0, 3, 1) = {0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(Spectrum{zero}, std::invalid_argument);
}

/// Slow decay over a large mean: degrees up to 32 hold little of the tail, those up to 200 most of it.
TEST(Resolution, NeverAsksForFewerLatitudesThanDoNotSuffice) {
  for (const int latitudes : {8, 16, 32}) {
    Surface surface(latitudes);
    VectorField x = sphere(surface.grid());
    const ScalarField noise = testing::smooth_scalar(surface.grid(), latitudes, 3);
    for (int component = 0; component < 3; ++component) x.col(component) *= 1 + 1e-5 * noise;
    surface.update(x);
    for (const double tolerance : {0.5, 0.05, 1e-3, 1e-5}) {
      const Resolution r = resolution(surface, tolerance);
      if (!r.sufficient() && r.needed_latitudes > 0) {
        EXPECT_GT(r.needed_latitudes, latitudes) << tolerance;
      }
    }
  }
}

/// Round-off of the positions grows like the degree to the power 5/2 in the curvature: from 128 latitudes on it is more than 1e-13 of it.
TEST(Resolution, RoundOffIsNotAShape) {
  Surface surface(128);
  const SphereGrid& grid = surface.grid();
  const ScalarField noise = testing::smooth_scalar(grid, grid.latitudes(), 3);
  for (const VectorField& x :
       {sphere(grid), prolate(grid, 0.9999), ellipsoid(grid, {1, 1, 1.001}), prolate(grid, 0.95),
        sphere(grid, {.centre = {30, 7, 0.3}}), VectorField(sphere(grid).colwise() * (1 + 1e-15 * noise))}) {
    surface.update(x);
    EXPECT_EQ(resolution_warning(resolution(surface)), "");
  }
  for (const VectorField& x : {VectorField(sphere(grid).colwise() * (1 + 1e-6 * noise)), ellipsoid(grid, {1, 1, 40})}) {
    surface.update(x);
    EXPECT_FALSE(resolution(surface).sufficient());
  }
  Surface fine(256);
  fine.update(sphere(fine.grid()));
  EXPECT_EQ(resolution_warning(resolution(fine)), "");
}

TEST(Resolution, DoesNotDependOnTheUnitOfLength) {
  Surface surface(24);
  const VectorField x = ellipsoid(surface.grid(), {1, 1, 2});
  surface.update(x);
  const Resolution one = resolution(surface);
  for (const double scale : {1e-8, 1e8}) {
    surface.update(scale * x);
    const Resolution other = resolution(surface);
    EXPECT_NEAR(other.unresolved, one.unresolved, 1e-6 * one.unresolved);
    EXPECT_EQ(other.needed_latitudes, one.needed_latitudes);
  }
}

}  // namespace
}  // namespace vesiflow::vesicle::spectrum_test
