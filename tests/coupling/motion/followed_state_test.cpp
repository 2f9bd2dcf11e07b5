// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/followed_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "motion/following_history.h"
#include "motion/path_error.h"

namespace vesiflow::coupling::followed_state_test {
namespace {

constexpr Eigen::Index markers = 7;

FollowedState::Fields numbers(int columns, double seed) {
  FollowedState::Fields fields(markers, columns);
  for (Eigen::Index i = 0; i < fields.size(); ++i) fields(i) = std::sin(seed + 1.3 * static_cast<double>(i));
  return fields;
}

/// After a start and two steps of unequal length.
FollowedState stepped(bool has_strain) {
  FollowedState state(markers, has_strain);
  const FollowedState::Fields y = numbers(4, 0.1);
  state.start(y.leftCols<3>(), y.col(3));
  state.advance(0.1, numbers(state.fields(), 0.2));
  state.advance(0.15, numbers(state.fields(), 0.3));
  return state;
}

TEST(FollowedState, AddsIncrementsAndExtrapolatesByTheLast) {
  for (const bool has_strain : {true, false}) {
    const FollowedState state = stepped(has_strain);
    const int n = state.fields();
    const FollowedState::Fields expected = numbers(4, 0.1).leftCols(n) + numbers(n, 0.2) + numbers(n, 0.3);
    EXPECT_LT((state.now() - expected).abs().maxCoeff(), 1e-15);
    FollowedState::Fields y;
    state.extrapolate(state.scheme(0.3), y);
    EXPECT_LT((y - expected - 2.0 * numbers(n, 0.3)).abs().maxCoeff(), 1e-14);
  }
}

TEST(FollowedState, AShiftOfTheStrainIsPartOfTheLastStep) {
  FollowedState state = stepped(true);
  const FollowedState::Fields y = state.now(), d = state.last_increment();
  state.shift_strain(0.25);
  EXPECT_TRUE((state.now().leftCols<3>() == y.leftCols<3>()).all());
  EXPECT_LT((state.now().col(3) - y.col(3) - 0.25).abs().maxCoeff(), 1e-15);
  EXPECT_LT((state.last_increment().col(3) - d.col(3) - 0.25).abs().maxCoeff(), 1e-15);
}

TEST(FollowedState, SplitsIntoPositionsAndStrainOrNone) {
  vesicle::VectorField positions;
  vesicle::ScalarField strain;
  FollowedState::split(numbers(4, 1.0), positions, strain);
  EXPECT_TRUE((positions == numbers(4, 1.0).leftCols<3>()).all());
  EXPECT_TRUE((strain == numbers(4, 1.0).col(3)).all());
  FollowedState::split(numbers(3, 1.0), positions, strain);
  EXPECT_TRUE((strain == vesicle::ScalarField::Zero(markers)).all());
}

// With the positions, which are the membrane's, everything comes back: also through the row of numbers that a
// checkpoint has.
TEST(FollowedState, ARestoredOneIsTheSame) {
  for (const bool has_strain : {true, false}) {
    const FollowedState state = stepped(has_strain);
    PathError error(markers);
    error.add(Bdf2::of(0.1, 0.1), numbers(3, 2.0));
    const std::vector<double> owed{1.0, 2.0}, older{3.0, 4.0};
    std::vector<double> row{9.0};
    FollowingHistory{state.last_dt(), 2, error.steps(), state.strain(), state.increment(), error.bend(), owed, older}
        .write(row);

    const FollowingHistory read = FollowingHistory::read(
        row, {state.strain().size(), state.increment().size(), error.bend().size(), owed.size()});
    FollowedState other(markers, has_strain);
    other.restore(read.last_dt, read.strain, read.increment);
    EXPECT_TRUE(other.knows_strain());
    EXPECT_FALSE(other.is_known());
    other.start(state.now().leftCols<3>());
    EXPECT_TRUE(other.is_known());
    EXPECT_TRUE((other.now() == state.now()).all());
    EXPECT_TRUE((other.last_increment() == state.last_increment()).all());
    EXPECT_EQ(other.last_dt(), state.last_dt());
    EXPECT_EQ(read.owed_steps, 2);
    EXPECT_EQ(read.smooth_steps, 1);
    EXPECT_TRUE(std::equal(owed.begin(), owed.end(), read.last_owed.begin(), read.last_owed.end()));
    EXPECT_TRUE(std::equal(older.begin(), older.end(), read.older_owed.begin(), read.older_owed.end()));

    other.restart();
    EXPECT_FALSE(other.knows_strain());
    EXPECT_EQ(other.scheme(0.1).ratio, 0.0);
    EXPECT_EQ(other.last_increment().abs().maxCoeff(), 0.0);
  }
}

TEST(FollowingHistory, RefusesWhatIsNone) {
  const FollowingHistory::Sizes sizes{.strain = 1, .increment = 2, .bend = 1, .owed = 1};
  const std::vector<double> good{0.1, 2, 5, 1, 2, 3, 4, 5, 6};
  EXPECT_NO_THROW(FollowingHistory::read(good, sizes));
  std::vector<double> row = good;
  row.pop_back();
  EXPECT_THROW(FollowingHistory::read(row, sizes), std::invalid_argument);
  for (std::size_t i = 0; i < 3; ++i)
    for (const double wrong : {-1.0, static_cast<double>(NAN)}) {
      row = good;
      row[i] = wrong;
      EXPECT_THROW(FollowingHistory::read(row, sizes), std::invalid_argument) << i;
    }
}

// Of a cubic path the second differences are known, and the third derivative is the same everywhere.
TEST(PathError, IsTheErrorOfBdf2OnACubicPath) {
  const auto x = [](double t) { return 0.4 * t + 0.7 * t * t + 1.5 * t * t * t; };
  const double third = 9.0;
  // For steps that differ, up to terms that vanish with their difference.
  for (const double dt : {0.1, 0.05}) {
    PathError error(markers);
    double t = 0.0;
    for (int i = 0; i < 4; ++i, t += dt) {
      EXPECT_EQ(error.value().has_value(), i > 2) << i;
      const double second_difference = (x(t + 2 * dt) - x(t + dt)) - (x(t + dt) - x(t));
      error.add(Bdf2::of(dt, dt), vesicle::VectorField::Constant(markers, 3, second_difference));
    }
    ASSERT_TRUE(error.value());
    EXPECT_NEAR(*error.value(), std::sqrt(3.0) * 2.0 / 9.0 * dt * dt * dt * third, 1e-12);
  }
}

TEST(PathError, IsNoneOnAParabolaOfUnequalSteps) {
  const auto x = [](double t) { return 0.4 * t + 0.7 * t * t; };
  PathError error(markers);
  double t = 0.0, last = 0.1;
  for (const double dt : {0.1, 0.13, 0.08, 0.2}) {
    const double r = dt / last, second_difference = (x(t + dt) - x(t)) - r * (x(t) - x(t - last));
    error.add(Bdf2::of(dt, last), vesicle::VectorField::Constant(markers, 3, second_difference));
    t += dt;
    last = dt;
  }
  ASSERT_TRUE(error.value());
  EXPECT_LT(*error.value(), 1e-14);
}

}  // namespace
}  // namespace vesiflow::coupling::followed_state_test
