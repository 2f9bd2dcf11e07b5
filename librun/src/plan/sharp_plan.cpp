// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/sharp_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vesiflow::run {

double fluid_solves(const Scene& scene) {
  if (scene.corrects_fluid()) return 2.0;
  if (!scene.has_scaled_velocity()) return 1.0;
  return 5.0;
}

std::string describe_jumps(const Scene& scene) {
  return fmt::format(
      "of velocity and pressure at membranes without thickness, for forces of degrees n < 1.5 R/h; velocities of {} by "
      "4 x 4 x 4 points of Lagrange",
      scene.has_scaled_velocity() ? "equal viscosities" : "the membranes");
}

std::string describe_interface_passes(const Scene& scene) {
  const auto [least, greatest] = scene.viscosity_range();
  return fmt::format("by iteration, mu between {:g} and {:g}: about {:g} solves with viscosity 1 in a step", least,
                     greatest, fluid_solves(scene));
}

double sharp_bytes(const Scene& scene) {
  constexpr double of_point = 24.0, of_foot = 180.0, of_node = 500.0;
  constexpr double bands = 4.0, band_width = 7.0;  // of the components and the pressure; both sides, in spacings
  double bytes = 0.0;
  for (const coupling::VesicleParameters& vesicle : scene.vesicles) {
    const double radius = vesicle.radius / scene.spacing();
    const double points = std::pow(2.4 * radius + band_width + 4.0, 3);
    const double feet = 4.0 * std::numbers::pi * radius * radius * band_width;
    const double latitudes = std::numbers::pi * radius / 0.9;
    bytes += bands * (of_point * points + of_foot * feet) + of_node * 2.0 * latitudes * latitudes;
  }
  return bytes;
}

}  // namespace vesiflow::run
