// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/volume.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
void add_volume_penalty(const Surface& surface, double stiffness, double target_volume, VectorField& force) {
  check_penalty(stiffness, "target_volume", target_volume);
  check_markers(force, "force", surface.grid().size());
  const double pressure = stiffness * (surface.volume() - target_volume) / target_volume;
  force -= pressure * surface.normal();
}

double volume_penalty_energy(const Surface& surface, double stiffness, double target_volume) {
  check_penalty(stiffness, "target_volume", target_volume);
  const double excess = surface.volume() - target_volume;
  return 0.5 * stiffness * excess * excess / target_volume;
}

}  // namespace vesiflow::vesicle
