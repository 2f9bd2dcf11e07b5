// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "fluid/phase_account.h"

namespace vesiflow::coupling {

/// What the phases of the steps have taken since construction, none of them counted in another.
struct Phases {
  fluid::PhaseAccount membrane;              ///< geometry and forces of the membranes' own
  fluid::PhaseAccount external_forces;       ///< buoyancy and repulsion
  fluid::PhaseAccount spread;                ///< clearing, weights, spreading
  fluid::PhaseAccount indicator;             ///< field of viscosity, where the vesicles' differs
  fluid::PhaseAccount fluid_convection;      ///< explicit right-hand side
  fluid::PhaseAccount fluid_viscous;         ///< what the field of viscosity costs the fluid beside its solves
  fluid::PhaseAccount fluid_momentum;        ///< three velocity solves; without inertia the Stokes solve
  fluid::PhaseAccount fluid_projection;      ///< pressure solve and correction
  fluid::PhaseAccount interpolate;           ///< weights, interpolation
  fluid::PhaseAccount thickness_correction;  ///< of the interpolated velocity
  fluid::PhaseAccount mesh;                  ///< velocity filter, move, target areas
  fluid::PhaseAccount redistribution;        ///< looks at the meshes and what follows from them
  fluid::PhaseAccount adaptation;            ///< remembering and taking back of adaptive steps, and of a start
  fluid::PhaseAccount diagnostics;           ///< measures of the membranes
};

/// Calls visit(name, account) for each, in the order above; the names are those of summary.json.
template <class Accounts, class Visit>
void visit_phases(Accounts& phases, Visit&& visit) {
  visit("membrane", phases.membrane);
  visit("external_forces", phases.external_forces);
  visit("spread", phases.spread);
  visit("indicator", phases.indicator);
  visit("fluid_convection", phases.fluid_convection);
  visit("fluid_viscous", phases.fluid_viscous);
  visit("fluid_momentum", phases.fluid_momentum);
  visit("fluid_projection", phases.fluid_projection);
  visit("interpolate", phases.interpolate);
  visit("thickness_correction", phases.thickness_correction);
  visit("mesh", phases.mesh);
  visit("redistribution", phases.redistribution);
  visit("adaptation", phases.adaptation);
  visit("diagnostics", phases.diagnostics);
}

/// How often parts of the phases above were entered that parameters can switch off, summed over the membranes.
struct PartEntries {
  std::int64_t tension = 0;       ///< force of sigma0, in membrane
  std::int64_t strain = 0;        ///< target areas or strain field, in mesh
  std::int64_t conservation = 0;  ///< projections on volume and area, in mesh
};

}  // namespace vesiflow::coupling
