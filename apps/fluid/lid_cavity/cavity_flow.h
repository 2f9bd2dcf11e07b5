// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "fluid/field.h"
#include "profile.h"
#include "published.h"
#include "steady_run.h"

namespace cavity {

/// The flow in the cube [0, 1]^3 whose wall y = 1 moves with velocity 1 along x, all other walls at rest, on cells^3 cells.
///
/// The lid's velocity jumps at its four edges. It is sampled as it is, without smoothing: 1 at every point of the lid; the
/// walls beside it are at rest at all of their points, the nearest of which are half a cell or a cell below.
struct CavityFlow {
  int cells;
  SteadyRun run;
  vesiflow::fluid::FaceVector velocity;
  Profile u_along_y;  ///< u at (1/2, y, 1/2)
  Profile v_along_x;  ///< v at (x, 1/2, 1/2)

  Extremum u_minimum() const { return u_along_y.minimum(); }
  Extremum v_maximum() const { return v_along_x.maximum(); }
  Extremum v_minimum() const { return v_along_x.minimum(); }
};

/// Starts from rest, or from the velocity of another grid, interpolated. The largest step and the time scale of the options
/// are set here: lid times, and at most the decay time of the slowest viscous mode, Re / (3 pi^2), for a step.
CavityFlow compute_cavity(int cells, double reynolds_number, SteadyOptions options,
                          const vesiflow::fluid::FaceVector* start = nullptr);

/// The values of a profile at published positions.
std::vector<double> sampled(const Profile& profile, std::span<const PublishedPoint> points);

/// The value at h = 0 of what is coarse at h and fine at h / ratio, with an error of O(h^2).
double extrapolated(double coarse, double fine, double ratio);

/// Differences of values from published ones.
struct Deviation {
  double rms, max;
};
Deviation deviation(std::span<const double> values, std::span<const PublishedPoint> points);

}  // namespace cavity
