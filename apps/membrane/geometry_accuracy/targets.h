// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement.h"

/// One number that is to be reached.
struct Verdict {
  std::string quantity;
  double found, limit;
  std::string reason;  ///< why it was missed, as far as the measurement shows it

  bool met() const { return found <= limit; }
};

/// For the surfaces of Table 1: H and K at or below a tenth of the paper's errors; Lap H (Cartesian form on twice the
/// latitudes, not truncated) at N = 64 below 1e-7 on the ellipsoid and 5e-5 on the Y_3^2 surface, at N = 128 below 1e-7 on
/// both. Empty for other surfaces and grids.
std::vector<Verdict> verdicts(const Measurement& measurement);
