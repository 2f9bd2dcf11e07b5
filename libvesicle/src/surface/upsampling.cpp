// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/upsampling.h"

#include <stdexcept>

#include "check.h"

namespace vesiflow::vesicle {

double factor(Upsampling upsampling) {
  switch (upsampling) {
    case Upsampling::none:
      return 1;
    case Upsampling::three_halves:
      return 1.5;
    case Upsampling::twice:
      return 2;
    case Upsampling::automatic:
      break;
  }
  throw std::invalid_argument("upsampling = automatic: has no factor of its own; ask choose_upsampling");
}

int upsampled_latitudes(int latitudes, Upsampling upsampling) {
  const int halves = static_cast<int>(2 * factor(upsampling));
  return (halves * latitudes + 1) / 2;
}

Upsampling choose_upsampling(const Spectrum& mean_curvature, double tolerance) {
  check_argument(tolerance > 0, "tolerance", tolerance, "> 0");
  for (const Upsampling candidate : {Upsampling::none, Upsampling::three_halves})
    if (mean_curvature.laplacian_tail(upsampled_latitudes(mean_curvature.degrees(), candidate)) < tolerance)
      return candidate;
  return Upsampling::twice;
}

}  // namespace vesiflow::vesicle
