// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fluid/view.h"
#include "transfer/grid_band.h"

namespace vesiflow::coupling {

/// The points of one centring of the grid that are inside a membrane, as runs along x.
///
/// Points next to the membrane know their side by their signed distance. Where a line of points along x crosses the
/// membrane, the two points on either side of it are no further than a spacing from it: all other points are on the side
/// of the one next to them, and a line ends outside.
class InsidePoints {
 public:
  /// Points `first` to `last` - 1 of a line. Indices run on across periodic axes, as those of GridBand do.
  struct Run {
    int first, last, j, k;
  };

  /// Finds the points. The band must be at least as wide as `spacing`, that of the grid along x.
  void find(const GridBand& band, double spacing);

  const std::vector<Run>& runs() const { return runs_; }

  /// Multiplies a field of the same centring at these points, everywhere it holds them: across a periodic axis the last
  /// face is the first, and ghosts are points of the other end.
  void multiply(double factor, const fluid::Grid& grid, const fluid::View& points) const;

 private:
  std::vector<Run> runs_;
};

}  // namespace vesiflow::coupling
