// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fluid/export.h"
#include "fluid/navier_stokes.h"

namespace vesiflow::fluid {

/// Largest time step at which the extrapolated convection is stable for flow along an axis. By the roots of the
/// recurrence for a wave of phase theta from cell to cell,
///
///     3/2 u'' - 2 u' + 1/2 u + i C sin(theta) (2 u' - u) + 4 D sin^2(theta/2) (m u'' - (m - 1) v) = 0,
///
/// with C = U dt/h, D = dt/(Re h^2). Where the viscosity varies, m is the largest one, which is solved for everywhere,
/// and the rest is explicit (v = u') or extrapolated (v = 2 u' - u); otherwise, and with an implicit treatment, m = 1.
/// The limit of C for m = 1 is within 12 % of 1.15 Pe^(-1/3) + 0.33/Pe^2 for Pe = Re U h of 1 to 500; an extrapolated
/// viscous term at m = 20 has 0.24 at Pe = 5, instead of 0.68. Infinite for Re = 0 or U = 0, and where it exceeds C =
/// 100.
/// \param speed U along the axis.
/// \param spacing h along the axis.
/// \param reynolds_number Re, of a fluid of viscosity 1.
/// \param largest_viscosity m.
/// \param treatment which decides about v.
VESIFLOW_FLUID_EXPORT double stable_convection_step(double speed, double spacing, double reynolds_number,
                                                    double largest_viscosity = 1.0,
                                                    ViscousTreatment treatment = ViscousTreatment::implicit);

}  // namespace vesiflow::fluid
