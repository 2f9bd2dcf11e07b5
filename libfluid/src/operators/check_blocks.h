// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Public functions that take vectors of unknowns check, once in a call, that these have the shape of the problem.
#pragma once

#include "fluid/elliptic_problem.h"

namespace vesiflow::fluid {

// Throws std::invalid_argument with function, argument, and the numbers found and wanted, unless the arrays are as many as the blocks
// of the problem and each has the extent of its block.
void check_blocks(const char* function, const char* argument, ConstBlocks arrays, const EllipticProblem& problem);

}  // namespace vesiflow::fluid
