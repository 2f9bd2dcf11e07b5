// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "report/real_coefficients.h"
#include "report/stored_run.h"

namespace vesiflow::run {

/// A field on the membranes that a report shows, and the columns of coefficients that it has.
struct MembraneField {
  const char* name;   ///< the data set of docs/results.md; the speed is that of `velocity`
  const char* label;  ///< for people
  const char* unit;
  int first, components;
};
inline constexpr std::array<MembraneField, 5> membrane_fields = {
    {{"positions", "positions", "r", 0, 3},
     {"tension", "tension", "viscosity × r / time", 3, 1},
     {"mean_curvature", "mean curvature", "1/r", 4, 1},
     {"local_area_error", "local area error", "relative", 5, 1},
     {"speed", "speed", "r / time", 6, 1}}};
inline constexpr int membrane_columns = 7;

/// Where the membranes of a run were, as coefficients of `membrane_fields`.
struct MembraneCourse {
  struct Frame {
    double time = 0.0;
    long step = 0;
    std::vector<RealCoefficients> vesicles;
  };
  /// The values of a field, for the scale of its colours and the error that may be made.
  struct Range {
    double low = 0.0, high = 0.0;  ///< all but the lowest and the highest half per cent of the values
    double typical = 0.0;          ///< difference of largest and least in the middle one of the frames
  };

  std::size_t stored = 0;  ///< how many snapshots the run has
  std::vector<int> latitudes;
  std::vector<Frame> frames;
  std::array<Range, membrane_fields.size()> ranges;
  std::vector<std::string> missing;  ///< what could not be read and why
};

/// Of at most so many snapshots, evenly chosen. Those that are damaged or not finite are left out.
MembraneCourse read_membranes(const StoredRun& run, std::size_t most_frames);

}  // namespace vesiflow::run
