// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/bdf2.h"

namespace vesiflow::coupling {

/// What a membrane's fluid is within a time step: its momentum a u - mu Lap u + grad p = f has a = Re a0/dt with
/// inertia, and a part of the viscosity that the solve takes and another that its explicit term takes off again.
struct SurroundingFluid {
  bool has_inertia = false;
  double reynolds_number = 0.0;
  double solved_viscosity = 1.0;        ///< mu of the solve, of the mean of both sides unless a part is explicit
  double explicit_viscosity = 0.0;      ///< what the explicit term takes off it
  bool extrapolates_viscosity = false;  ///< the explicit term is extrapolated to the new time, and not the last one's
  bool is_thin_inside = false;          ///< the viscosity is smaller inside of this membrane than outside

  struct Viscosities {
    double own_ratio = 1.0;            ///< of the vesicle, inside over outside
    double largest = 1.0;              ///< of all vesicles and the outer fluid
    bool is_explicit_in_part = false;  ///< a contrast, with inertia, and not all in the solve
  };
  void set_viscosities(const Viscosities& viscosities);

  /// a of the coming step; 0 without inertia.
  double acceleration(double dt, const Bdf2& scheme) const {
    return has_inertia ? reynolds_number * scheme.leading / dt : 0.0;
  }
  /// Share of a in the response to waves of the length of the membrane, a/(a + mu/R^2).
  double inertia_share(double acceleration, double radius) const {
    return acceleration / (acceleration + solved_viscosity / (radius * radius));
  }
  /// What the explicit part of the viscosity adds to an overestimate of the stiffness, and what of it the fluid is
  /// told of (motion/constants.h).
  double lagging_overestimate() const;
  double remembered_viscosity() const;
};

}  // namespace vesiflow::coupling
