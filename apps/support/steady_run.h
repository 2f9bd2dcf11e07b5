// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "fluid/navier_stokes.h"

/// How a flow is taken to its steady state. Velocities and lengths are those of NavierStokes.
struct SteadyOptions {
  /// The flow is steady when it changes by less than this per time_scale: max |du/dt| time_scale <= tolerance.
  double tolerance = 1e-8;
  double time_scale = 1.0;
  std::optional<double> time_step;  ///< fixed; else chosen by the two limits below
  /// max over the cells of dt (|u|/dx + |v|/dy + |w|/dz), the explicit convection's limit. The flow's velocities are taken to
  /// be of order 1: it starts as if one of 1 were there already.
  double courant_number = 0.5;
  double largest_time_step = 1.0;
  double end = 1e3;      ///< gives up at this time
  bool progress = true;  ///< about once a second, on standard error, with an estimate of the time left
};

struct SteadyRun {
  bool steady = false;  ///< false: stopped at the end
  double change = 0;    ///< max |du/dt| time_scale at last
  double time = 0;
  double time_step = 0;  ///< the last
  std::int64_t steps = 0;
  double seconds = 0;  ///< wall time
};

/// Steps the flow from where it is. Throws what NavierStokes::step() throws, and Stopped of program.h with the time and the
/// step if the velocity passes 100: the step was too long for the explicit convection.
SteadyRun run_to_steady_state(vesiflow::fluid::NavierStokes& fluid, const SteadyOptions& options);

/// max over the cells of |u|/dx + |v|/dy + |w|/dz with the largest velocity on the cell's faces.
double courant_rate(const vesiflow::fluid::FaceVector& velocity);

/// max |a - b| over the faces.
double max_difference(const vesiflow::fluid::FaceVector& a, const vesiflow::fluid::FaceVector& b);
