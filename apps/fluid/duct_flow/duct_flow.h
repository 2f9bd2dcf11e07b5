// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "fluid/duct_series.h"
#include "fluid/field.h"
#include "steady_run.h"

/// periodic: repeating along the flow, driven by a uniform body force; walls: velocity of the series on both ends.
enum class DuctEnds { periodic, walls };

/// unsteady: Navier-Stokes from rest to the steady state; stokes: the Stokes problem solved at once.
enum class DuctMethod { unsteady, stokes };

/// The duct [-length/2, length/2] x [-d, d] x [-e, e] of DuctSeries.
struct Duct {
  double d = 1, e = 1, length = 2;
  DuctEnds ends = DuctEnds::periodic;
  double reynolds_number = 1;

  /// Decay time of the slowest mode across the duct, Re / ((pi/2d)^2 + (pi/2e)^2).
  double diffusion_time() const;
};

struct DuctFlow {
  std::array<int, 3> cells;
  /// With DuctMethod::stokes: steps are the solver's iterations, the change is its relative residual, times are zero.
  SteadyRun run;
  vesiflow::fluid::FaceVector velocity;
  double error_l2;  ///< of the velocity along the duct, root mean square over its points
  double error_max;
  double cross_flow;  ///< max of the velocities across the duct, which are zero in the exact flow
};

/// Time scale and longest step are set here. The scale is the diffusion time T. With periodic ends a flow from rest has no
/// convection at all, and a step of 10 T is taken, which leaves a fifth of what is missing. With walls it is T, where the
/// pressure converges fastest, or less by the Courant number.
DuctFlow compute_duct(const Duct& duct, const std::array<int, 3>& cells, DuctMethod method, SteadyOptions options);
