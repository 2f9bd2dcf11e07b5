// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion/following_history.h"

#include <stdexcept>
#include <string>

namespace vesiflow::coupling {
namespace {

constexpr std::size_t numbers_at_first = 3;

}  // namespace

void FollowingHistory::write(std::vector<double>& row) const {
  row.assign({last_dt, static_cast<double>(owed_steps), static_cast<double>(smooth_steps)});
  for (const auto& part : {strain, increment, bend, last_owed, older_owed})
    row.insert(row.end(), part.begin(), part.end());
}

FollowingHistory FollowingHistory::read(std::span<const double> row, const Sizes& sizes) {
  const std::size_t size = numbers_at_first + sizes.strain + sizes.increment + sizes.bend + 2 * sizes.owed;
  if (row.size() != size)
    throw std::invalid_argument("shape_following: a history of " + std::to_string(row.size()) + " values, expected " +
                                std::to_string(size));
  const auto is_count = [](double value) { return value >= 0.0 && value <= 1e9; };
  if (!(row[0] >= 0.0) || !is_count(row[1]) || !is_count(row[2]))
    throw std::invalid_argument("shape_following: a history of a step of " + std::to_string(row[0]) + " with counts " +
                                std::to_string(row[1]) + " and " + std::to_string(row[2]) +
                                ": must be >= 0, the counts <= 1e9");
  FollowingHistory history{row[0], static_cast<int>(row[1]), static_cast<int>(row[2]), {}, {}, {}, {}, {}};
  std::size_t first = numbers_at_first;
  const auto take = [&](std::size_t count) {
    first += count;
    return row.subspan(first - count, count);
  };
  history.strain = take(sizes.strain);
  history.increment = take(sizes.increment);
  history.bend = take(sizes.bend);
  history.last_owed = take(sizes.owed);
  history.older_owed = take(sizes.owed);
  return history;
}

}  // namespace vesiflow::coupling
