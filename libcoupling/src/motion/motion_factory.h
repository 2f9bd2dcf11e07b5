// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

#include "coupling/flow.h"
#include "coupling/simulation_parameters.h"
#include "motion/membrane_motion.h"
#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// The motion that time.markers names, for the membrane of that vesicle.
std::unique_ptr<MembraneMotion> make_membrane_motion(const SimulationParameters& parameters, const Flow& flow,
                                                     std::size_t vesicle, const vesicle::Membrane& membrane);

}  // namespace vesiflow::coupling
