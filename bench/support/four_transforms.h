// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The transforms of the four fast solves of a step of the fluid, as FFTW alone does them: what steps are measured against.
#pragma once

#include <array>
#include <memory>

#include "fluid/grid.h"
#include "support/timing.h"
#include "support/yardsticks.h"

namespace vesiflow::bench {

// There and back for the pressure and three velocity components.
class FourTransforms {
 public:
  FourTransforms(const fluid::Grid& grid, unsigned planning) {
    using namespace fluid;
    const EllipticProblem pressure(grid, Centring::cell, BoundaryCondition::neumann, 0.0, 1.0);
    const EllipticProblem velocity = EllipticProblem::velocity(grid, EllipticForm::laplacian, 1.0, 1.0);
    pairs_[0] = std::make_unique<R2rPair>(pressure, planning);
    for (int c = 0; c < 3; ++c) pairs_[c + 1] = std::make_unique<R2rPair>(velocity.component(c), planning);
  }
  Sample measure() {
    Sample sum;
    for (const auto& pair : pairs_) {
      pair->clear();
      sum += timed([&] { pair->execute(); });
    }
    return sum;
  }

 private:
  std::array<std::unique_ptr<R2rPair>, 4> pairs_;
};

}  // namespace vesiflow::bench
