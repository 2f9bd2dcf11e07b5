// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/fixed_point.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/marker_integrator.h"

namespace vesiflow::coupling::fixed_point_test {
namespace {

// x = b - a x, component by component, with factors that the plain iteration multiplies errors by: up to 3.
constexpr std::array<double, 5> factors{3.0, 2.0, 0.5, -0.5, 0.1};

struct Linear {
  int evaluations = 0;
  void operator()(std::span<const double> x, std::span<double> result) {
    ++evaluations;
    for (std::size_t i = 0; i < factors.size(); ++i) result[i] = 1.0 - factors[i] * x[i];
  }
};

#define SKIP_WITHOUT_SUNDIALS \
  if (!have_sundials()) GTEST_SKIP() << "built without SUNDIALS"

// Anderson acceleration of a linear map is GMRES: with as many iterates remembered as there are eigenvalues it ends.
TEST(FixedPoint, SolvesALinearMapThatDivergesInAsManyEvaluationsAsItHasEigenvalues) {
  SKIP_WITHOUT_SUNDIALS;
  const auto solver = make_fixed_point(factors.size(), {1e-9, 20});
  Linear map;
  std::vector<double> x(factors.size(), 0.0);
  solver->solve(std::ref(map), x);
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_NEAR(x[i], 1.0 / (1.0 + factors[i]), 1e-8);
  EXPECT_LE(map.evaluations, static_cast<int>(factors.size()) + 3);
  // Nothing is remembered from one solve to the next.
  std::vector<double> again(factors.size(), 0.0);
  solver->solve(std::ref(map), again);
  EXPECT_EQ(x, again);
}

TEST(FixedPoint, SaysHowFarItGot) {
  SKIP_WITHOUT_SUNDIALS;
  const auto solver = make_fixed_point(factors.size(), {1e-9, 3});
  Linear map;
  std::vector<double> x(factors.size(), 0.0);
  try {
    solver->solve(std::ref(map), x);
    FAIL();
  } catch (const NoFixedPoint& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("after 3 evaluations the last change is"), std::string::npos) << text;
    EXPECT_NE(text.find("1e-09"), std::string::npos) << text;
  }
  EXPECT_EQ(map.evaluations, 3);
}

TEST(FixedPoint, ErrorsOfTheMapComeThroughAndItCanBeUsedAgain) {
  SKIP_WITHOUT_SUNDIALS;
  const auto solver = make_fixed_point(1, {1e-9, 20});
  std::vector<double> x{0.0};
  EXPECT_THROW(solver->solve([](std::span<const double>, std::span<double>) { throw std::out_of_range("lost"); }, x),
               std::out_of_range);
  x = {0.0};
  solver->solve([](std::span<const double> at, std::span<double> result) { result[0] = std::cos(at[0]); }, x);
  EXPECT_NEAR(x[0], 0.7390851332151607, 1e-8);
}

TEST(FixedPoint, ABuildWithoutSundialsSaysSo) {
  if (have_sundials()) GTEST_SKIP() << "built with SUNDIALS";
  EXPECT_THROW(make_fixed_point(1, {}), std::invalid_argument);
}

}  // namespace
}  // namespace vesiflow::coupling::fixed_point_test
