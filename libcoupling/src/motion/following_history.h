// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace vesiflow::coupling {

/// What a continued run of shape following needs beside the positions, and the row of numbers that a checkpoint has
/// of it:
///   last_dt, owed_steps, smooth_steps, strain, increment, bend, owed forces of the last step and of the one before.
struct FollowingHistory {
  struct Sizes {
    std::size_t strain = 0, increment = 0, bend = 0;
    std::size_t owed = 0;  ///< of one step; 0 without inertia
  };

  double last_dt = 0.0;  ///< of the last step
  int owed_steps = 0;    ///< of those that have left owed forces, up to 2
  int smooth_steps = 0;  ///< since a start
  std::span<const double> strain, increment, bend, last_owed, older_owed;

  /// Takes the place of what is in `row`.
  void write(std::vector<double>& row) const;
  /// Views of the row.
  /// \throws std::invalid_argument for a row of another size or with what is no length of a step or no count
  static FollowingHistory read(std::span<const double> row, const Sizes& sizes);
};

}  // namespace vesiflow::coupling
