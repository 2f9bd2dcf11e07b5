// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// What a sparse Cholesky factorisation will cost, before it is begun.
#pragma once

#include <string>

#include "fluid/elliptic_solver.h"

namespace vesiflow::fluid {

struct FactorEstimate {
  double bytes;  // of the factor and the work arrays of factorisation and solve
  double flops;  // of the factorisation
  double seconds() const;
};

// From the shape of the grid alone. Within a factor of 1.5 (bytes) and 2 (flops) of CHOLMOD's counts for boxes of 12^3 to
// 64^3 cells.
FactorEstimate rule_of_thumb(const EllipticProblem& problem);

// Throws std::invalid_argument if the rule of thumb, which may be high, is above twice a limit.
void check_limits(const EllipticProblem& problem, const CholmodOptions& options);

// Throws std::invalid_argument, with the estimate, the limit and the alternatives, if the estimate exceeds
// `slack` times a limit.
void check_limits(const EllipticProblem& problem, const FactorEstimate& estimate, const CholmodOptions& options,
                  double slack);

}  // namespace vesiflow::fluid
