#include "coupling/delta_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace vesiflow::coupling {
namespace {

// Values by 40-digit convolution of the 3-point function over one cell, independent of the closed form.
constexpr std::pair<double, double> reference[] = {
    {0.0, 0.6181999293593575},  {0.1, 0.609635946412666},   {0.5, 0.4670499823398394},  {0.9, 0.24446401826701272},
    {1.0, 0.19090003532032124}, {1.3, 0.07696256417875148}, {1.5, 0.03295001766016062}, {1.9, 0.000478672351102834},
};

TEST(SmoothedDelta, MatchesIndependentValues) {
  for (const auto& [r, value] : reference) {
    EXPECT_NEAR(smoothed_delta(r), value, 2e-15) << "r = " << r;
    EXPECT_EQ(smoothed_delta(-r), smoothed_delta(r));
  }
  EXPECT_EQ(smoothed_delta(2.0), 0.0);
  EXPECT_EQ(smoothed_delta(5.0), 0.0);
}

TEST(SmoothedDelta, HasUnitSumZeroFirstAndConstantSecondMomentWhereverTheMarkerIs) {
  for (int step = 0; step < 1000; ++step) {
    const double t = step / 1000.0;
    const auto w = smoothed_delta_weights(t);
    const double r[] = {-1.0 - t, -t, 1.0 - t, 2.0 - t};
    double sum = 0.0, first = 0.0, second = 0.0;
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(w[i], smoothed_delta(r[i]), 1e-15);
      sum += w[i];
      first += w[i] * r[i];
      second += w[i] * r[i] * r[i];
    }
    EXPECT_NEAR(sum, 1.0, 5e-15);
    EXPECT_NEAR(first, 0.0, 5e-15);
    EXPECT_NEAR(second, 0.3818000706406425, 1e-14);
  }
}

// C^2: the second difference has no jump larger than its own slope allows, at the joints 0, 1 and 2.
TEST(SmoothedDelta, IsTwiceContinuouslyDifferentiable) {
  const double e = 1e-3;
  const auto second = [&](double r) {
    return (smoothed_delta(r + e) - 2.0 * smoothed_delta(r) + smoothed_delta(r - e)) / (e * e);
  };
  for (const double joint : {0.0, 1.0, 2.0}) EXPECT_NEAR(second(joint - 2 * e), second(joint + 2 * e), 0.1);
}

}  // namespace
}  // namespace vesiflow::coupling
