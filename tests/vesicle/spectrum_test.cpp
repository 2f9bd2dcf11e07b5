#include "vesicle/spectrum.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/upsampling.h"

namespace vesiflow::vesicle {
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

}  // namespace
}  // namespace vesiflow::vesicle
