// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "report/stored_run.h"

namespace vesiflow::run {

/// The fluid in planes through the middle of the box, as integers: what a page draws a slice of.
struct FluidPlanes {
  /// A plane of constant x, y or z.
  struct Plane {
    int axis = 1;                                  ///< what is constant
    double position = 0.0;                         ///< and its value
    std::array<int, 2> points = {0, 0};            ///< along the two other axes, the lower one first
    std::array<double, 2> lower = {}, upper = {};  ///< of the box along these
    double velocity_quantum = 0.0, pressure_quantum = 0.0;
    /// Snapshot by snapshot: velocity along x, y, z, and the pressure, each points[1] rows of points[0] values of two bytes, lowest first.
    std::vector<std::uint8_t> bytes;
  };

  std::size_t stored = 0;     ///< how many snapshots the run has
  std::vector<double> times;  ///< of those that are kept
  std::vector<Plane> planes;
  std::vector<std::string> missing;  ///< what could not be read and why
};

/// In about so many bytes: all three planes; where there is no room for them in every snapshot only that of constant y, the plane of shear and
/// channel flows; where even that is too much, of fewer snapshots, evenly chosen. The plane of an axis that is mirrored is that of the mirror.
FluidPlanes read_fluid_planes(const StoredRun& run, std::size_t most_bytes);

}  // namespace vesiflow::run
