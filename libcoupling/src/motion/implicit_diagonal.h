// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "motion/increment_solver.h"
#include "motion/stiffness.h"
#include "motion/wave_damping.h"

namespace vesiflow::coupling {

/// The implicit terms of a step but for the slip, per degree: a0 + Z_n and the damping.
class ImplicitDiagonal {
 public:
  explicit ImplicitDiagonal(int degrees) : values_(static_cast<std::size_t>(degrees)) {}

  void find(double leading, const Stiffness& stiffness, const WaveDamping& damping) {
    for (std::size_t n = 0; n < values_.size(); ++n) {
      const auto degree = static_cast<int>(n);
      const Stiffness::Mode& z = stiffness[degree];
      values_[n] = {leading + z.position, leading + z.strain, damping[degree]};
    }
  }
  std::span<const IncrementSolver::Diagonal> values() const { return values_; }

 private:
  std::vector<IncrementSolver::Diagonal> values_;
};

}  // namespace vesiflow::coupling
