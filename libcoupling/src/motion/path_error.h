// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "motion/bdf2.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Local error of BDF2 in positions, 2/9 dt^3 X''', from the second differences d^{k+1} - r d^k = dt^2 (1 + 1/r)/2
/// X'' of steps that follow each other.
class PathError {
 public:
  explicit PathError(Eigen::Index markers);

  /// Takes the second difference of a step, shape (markers, 3); afterwards value() is its error.
  void add(const Bdf2& scheme, const Eigen::Ref<const vesicle::VectorField>& second_difference);

  /// Root mean square over the markers; nothing in the first two steps.
  std::optional<double> value() const { return value_; }

  /// Steps since a start, and dt^2 X'' of the last one: the history.
  int steps() const { return steps_; }
  std::span<const double> bend() const;
  void restore(int steps, std::span<const double> bend);
  void restart();

 private:
  vesicle::VectorField bend_, last_bend_;
  int steps_ = 0;
  std::optional<double> value_;
};

}  // namespace vesiflow::coupling
