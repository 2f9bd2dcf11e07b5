// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/scene.h"

namespace vesiflow::run {

/// Bytes that a run of a scene takes at its peak, by estimate: within 10 % of the resident size from about 50 MB on
/// (tests/apps/memory.sh).
struct MemoryPlan {
  double program = 0.0;    ///< the program with its libraries
  double fluid = 0.0;      ///< fields and solvers, that of the indicator too
  double membranes = 0.0;  ///< working arrays and tables of Legendre functions
  double steps = 0.0;      ///< what adaptive steps remember
  double output = 0.0;     ///< copies that the largest file is written from

  double total() const { return program + fluid + membranes + steps + output; }
};

/// Nothing of the size of the grid is allocated.
MemoryPlan plan_memory(const Scene& scene);

}  // namespace vesiflow::run
