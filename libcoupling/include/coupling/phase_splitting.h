// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/export.h"

namespace vesiflow::coupling {

/// How the inertia of two viscosities between sharp membranes is shared between the fluid's solver, which has one Reynolds
/// number for w = mu u, and a force on it. docs/jump_conditions.md, The acceleration that is extrapolated.
struct PhaseSplitting {
  double solved_reynolds_number;  ///< Re_s, of the solver
  double curvature;  ///< b in the extrapolation 2 w^k - w^(k-1) + b (w^k - 2 w^(k-1) + w^(k-2)) of the rest, 0 to 1
};

/// Of phases whose least and greatest viscosities are these, that of the outer one, 1, included.
/// \param reynolds_number Re of the outer phase \param is_slow whether the fluid forgets its velocity so fast that the
/// cheapest one will do
VESIFLOW_COUPLING_EXPORT PhaseSplitting phase_splitting(double reynolds_number, double least_ratio,
                                                        double greatest_ratio, bool is_slow);

}  // namespace vesiflow::coupling
