// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Adds the penalty force per unit area of Eq. (22), F_v = -c_v (V - V0)/V0 n, to `force`, shape (markers, 3).
/// \throws std::invalid_argument unless target_volume > 0 and stiffness >= 0, both finite.
VESIFLOW_VESICLE_EXPORT void add_volume_penalty(const Surface& surface, double stiffness, double target_volume,
                                                VectorField& force);

/// (c_v/2) (V - V0)^2 / V0, of which the penalty force is minus the derivative.
VESIFLOW_VESICLE_EXPORT double volume_penalty_energy(const Surface& surface, double stiffness, double target_volume);

}  // namespace vesiflow::vesicle
