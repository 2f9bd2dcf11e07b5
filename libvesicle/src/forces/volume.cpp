// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/volume.h"

#include <cmath>

#include "check.h"

namespace vesiflow::vesicle {
namespace {

void check_penalty(double stiffness, double target_volume) {
  check_argument(std::isfinite(stiffness) && stiffness >= 0, "stiffness", stiffness, "finite and >= 0");
  check_argument(std::isfinite(target_volume) && target_volume > 0, "target_volume", target_volume, "finite and > 0");
}

}  // namespace

void add_volume_penalty(const Surface& surface, double stiffness, double target_volume, VectorField& force) {
  check_penalty(stiffness, target_volume);
  check_markers(force, "force", surface.grid().size());
  const double pressure = stiffness * (surface.volume() - target_volume) / target_volume;
  force -= pressure * surface.normal();
}

double volume_penalty_energy(const Surface& surface, double stiffness, double target_volume) {
  check_penalty(stiffness, target_volume);
  const double excess = surface.volume() - target_volume;
  return 0.5 * stiffness * excess * excess / target_volume;
}

}  // namespace vesiflow::vesicle
