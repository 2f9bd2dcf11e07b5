// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/coefficient_packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vesicle/spherical_harmonics.h"

namespace vesiflow::run::coefficient_packing_test {
namespace {

constexpr int latitudes = 24;

// A smooth field that no symmetry makes simple, and three of them as positions.
Eigen::ArrayXXd fields(const vesicle::SphereGrid& grid, double time) {
  Eigen::ArrayXXd values(grid.size(), 4);
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i) {
      const double theta = grid.colatitude()[j], phi = grid.longitude(i);
      const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi), z = std::cos(theta);
      values.row(grid.index(i, j)) << 5.0 + 1.3 * x + 0.2 * y * z, 0.8 * y - 0.1 * x * x + time,
          0.7 * z + 0.05 * std::exp(x - y), std::exp(std::sin(2.0 * x - time) + 0.5 * y * z);
    }
  return values;
}

RealCoefficients coefficients_of(const vesicle::SphericalHarmonics& harmonics, double time) {
  vesicle::Coefficients coefficients;
  harmonics.analysis(fields(harmonics.grid(), time), coefficients);
  return real_coefficients(coefficients, latitudes);
}

// Root mean square over the sphere of the difference of two expansions, by quadrature on the grid.
double difference(const vesicle::SphericalHarmonics& harmonics, const RealCoefficients& a, const RealCoefficients& b,
                  int first, int count) {
  Eigen::ArrayXXd values(harmonics.grid().size(), a.cols());
  harmonics.synthesis(complex_coefficients(a - b), values);
  double sum = 0.0;
  const vesicle::SphereGrid& grid = harmonics.grid();
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      sum += grid.weight()[j] * grid.longitude_spacing() *
             values.row(grid.index(i, j)).segment(first, count).square().sum();
  return std::sqrt(sum / (4.0 * std::numbers::pi));
}

class Packing : public testing::Test {
 protected:
  Packing() : harmonics_(latitudes, vesicle::SphereGrid(latitudes), 4) {
    for (const double time : {0.0, 0.7, 3.1}) {
      frames_.push_back(coefficients_of(harmonics_, time));
      positions_.observe(frames_.back());
      field_.observe(frames_.back());
    }
  }

  // Packs and unpacks all frames; the largest error of a frame.
  double largest_error(const CoefficientExtent& extent, double tolerance) const {
    const CoefficientPacking packing(extent, tolerance);
    double largest = 0.0;
    for (const RealCoefficients& frame : frames_) {
      std::vector<std::uint8_t> bytes;
      packing.append(frame, bytes);
      EXPECT_EQ(bytes.size(), packing.bytes_per_frame());
      RealCoefficients unpacked = frame;
      packing.unpack(bytes, unpacked);
      largest = std::max(largest, difference(harmonics_, frame, unpacked, extent.first(), extent.components()));
    }
    return largest;
  }

  vesicle::SphericalHarmonics harmonics_;
  std::vector<RealCoefficients> frames_;
  CoefficientExtent positions_{0, 3}, field_{3, 1};
};

TEST_F(Packing, RealCoefficientsAreTheSameExpansion) {
  Eigen::ArrayXXd values(harmonics_.grid().size(), 4);
  harmonics_.synthesis(complex_coefficients(frames_[1]), values);
  EXPECT_LT((values - fields(harmonics_.grid(), 0.7)).abs().maxCoeff(), 2e-6);  // of floats
  // The sum of their squares is the integral of the square: of the constant 5 + ... the largest is 5 sqrt(4 pi).
  EXPECT_NEAR(static_cast<double>(frames_[0](0, 0)), 5.0 * std::sqrt(4.0 * std::numbers::pi), 1e-5);
}

// The error is what is allowed, and not a small part of it: bytes would be wasted.
TEST_F(Packing, ErrorIsTheOneAllowed) {
  for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
    for (const CoefficientExtent& extent : {positions_, field_}) {
      const double error = largest_error(extent, tolerance);
      EXPECT_LE(error, tolerance);
      EXPECT_GT(error, 0.2 * tolerance);
    }
  }
}

TEST_F(Packing, TakesFewerBytesTheMoreIsAllowed) {
  std::size_t before = frames_[0].rows() * sizeof(float);
  for (const double tolerance : {1e-6, 1e-4, 1e-2}) {
    const CoefficientPacking packing(field_, tolerance);
    EXPECT_LT(packing.bytes_per_frame(), before);
    before = packing.bytes_per_frame();
  }
  EXPECT_LT(CoefficientPacking(field_, 1e-2).degrees(), latitudes);
}

// A vesicle that has gone far has a first coefficient that no integer of two bytes holds.
TEST_F(Packing, LargeCoefficientsAreFloats) {
  RealCoefficients far = frames_[0];
  far(0, 0) = 4e6F;
  CoefficientExtent extent(0, 3);
  extent.observe(far);
  const CoefficientPacking packing(extent, 1e-4);
  EXPECT_EQ(packing.widths().substr(0, 1), "4");
  EXPECT_EQ(packing.widths().find('4', 1), std::string::npos);
  std::vector<std::uint8_t> bytes;
  packing.append(far, bytes);
  RealCoefficients unpacked = far;
  packing.unpack(bytes, unpacked);
  EXPECT_EQ(unpacked(0, 0), 4e6F);
  EXPECT_LE(difference(harmonics_, far, unpacked, 0, 3), 1e-4);
}

// Negative integers are negative again, whichever width they have.
TEST_F(Packing, SignsSurvive) {
  RealCoefficients frame = RealCoefficients::Zero(latitudes * latitudes, 4);
  frame(0, 3) = -100.0F;
  frame(1, 3) = -1.0F;
  frame(2, 3) = 1.0F;
  CoefficientExtent extent(3, 1);
  extent.observe(frame);
  const CoefficientPacking packing(extent, 0.02);
  EXPECT_EQ(packing.widths(), "21");
  std::vector<std::uint8_t> bytes;
  packing.append(frame, bytes);
  RealCoefficients unpacked = frame;
  packing.unpack(bytes, unpacked);
  EXPECT_LE((unpacked - frame).abs().maxCoeff(), static_cast<float>(0.5001 * packing.quantum()));
}

}  // namespace
}  // namespace vesiflow::run::coefficient_packing_test
