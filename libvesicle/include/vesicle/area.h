// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Adds the force per unit area F_a = -c_a (A - A0)/A0 2 H n, which keeps the total area, to `force`, shape (markers,
/// 3).
/// \throws std::invalid_argument unless target_area > 0 and stiffness >= 0, both finite.
VESIFLOW_VESICLE_EXPORT void add_area_penalty(const Surface& surface, double stiffness, double target_area,
                                              VectorField& force);

/// (c_a/2) (A - A0)^2 / A0, of which the penalty force is minus the derivative.
VESIFLOW_VESICLE_EXPORT double area_penalty_energy(const Surface& surface, double stiffness, double target_area);

/// dA/dt of markers that move with `velocity`, shape (markers, 3): int 2 H U . n dA.
/// \throws std::invalid_argument for a wrong size.
/// \throws std::domain_error if the velocity is not finite.
VESIFLOW_VESICLE_EXPORT double area_rate(const Surface& surface, const VectorField& velocity);

}  // namespace vesiflow::vesicle
