// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fluid/viscosity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid::viscosity_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Grid grid({0, 0, 0}, {1, 2, 3}, {5, 6, 7}, {.periodic = {false, true, false}});

// Numbers each cell.
double label(int i, int j, int k) {
  return 1.0 + i + 10.0 * j + 100.0 * k;
}

TEST(Viscosity, GhostsAreTheCellInsideOrThatOfTheOtherEnd) {
  Field<Cell> mu(grid);
  for (int k = 0; k < 7; ++k) {
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 5; ++i) mu(i, j, k) = label(i, j, k);
    }
  }
  extend_to_ghosts(mu);
  const auto inside = [](int index, int n) { return std::clamp(index, 0, n - 1); };
  for (int k = -1; k <= 7; ++k) {
    for (int j = -1; j <= 6; ++j) {
      for (int i = -1; i <= 5; ++i) {
        EXPECT_EQ(mu(i, j, k), label(inside(i, 5), (j + 6) % 6, inside(k, 7))) << i << ' ' << j << ' ' << k;
      }
    }
  }
}

TEST(Viscosity, RangeIncludesAllValues) {
  const auto mu = sample_viscosity(grid, [](const Vector3& r) { return 1.0 + r[0]; });
  const auto [min, max] = Viscosity(mu).checked_range();
  EXPECT_DOUBLE_EQ(min, 1.1);
  EXPECT_DOUBLE_EQ(max, 1.9);
  EXPECT_EQ(Viscosity(2.5).checked_range().min, 2.5);
}

TEST(Viscosity, RefusesValuesThatAreNotPositiveAndNamesThePlace) {
  for (const double bad :
       {0.0, -2.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto mu = sample_viscosity(grid, [](const Vector3&) { return 1.0; });
    (*mu)(4, 5, 6) = bad;
    EXPECT_THAT([&] { Viscosity(mu).checked_range(); },
                ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("cell (4, 5, 6) is "), HasSubstr("> 0"))));
    EXPECT_THAT([&] { Viscosity(bad).checked_range(); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("viscosity is ")));
  }
  EXPECT_THAT([] { Viscosity(std::shared_ptr<const Field<Cell>>()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("null")));
}

TEST(Viscosity, NamesTheCellAndNotTheGhostThatIsItsCopy) {
  const auto mu = sample_viscosity(grid, [](const Vector3& r) { return r[0] < 0.2 ? -1.0 : 1.0; });
  EXPECT_THAT([&] { Viscosity(mu).checked_range(); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("cell (0, 0, 0) is -1")));
}

TEST(Viscosity, SolversRefuseAFieldWithoutGhosts) {
  const auto mu = std::make_shared<Field<Cell>>(grid);
  mu->fill(1.0);
  (*mu)(-1, 2, 3) = 0.0;
  const auto problem = EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, Viscosity(mu));
  EXPECT_THAT([&] { make_elliptic_solver(problem, PcgOptions{}); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("cell (-1, 2, 3) is 0"), HasSubstr("ghost"))));
}

TEST(Viscosity, AFieldOfAnotherGridIsRefused) {
  const Grid other({0, 0, 0}, {1, 2, 3}, {5, 6, 8});
  const Viscosity mu(sample_viscosity(other, [](const Vector3&) { return 1.0; }));
  EXPECT_THAT([&] { EllipticProblem::velocity(grid, EllipticForm::stress, 1.0, mu); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("another grid")));
}

}  // namespace
}  // namespace vesiflow::fluid::viscosity_test
