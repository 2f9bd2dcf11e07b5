// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plan/sharp_plan.h"

#include <fmt/format.h>

namespace vesiflow::run {

double fluid_solves(const Scene& scene) {
  const double correction = scene.corrects_fluid(scene.time.step) ? 1.0 : 0.0;
  if (!scene.has_scaled_velocity()) return 1.0 + correction;
  // A vesicle that tank-treads on h = R/5.3 in steps of 1/24: 2.2 at ratios of 20 and 100, 2.4 at 5, 3.2 at 0.2, 3.6 at 0.05
  // (docs/coupling.md).
  return (scene.viscosity_range().least < 1.0 ? 3.4 : 2.4) + correction;
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

// Fitted to peaks of runs on 48^3 to 128^3 cells of [-6,6]^3 with 32 and 64 latitudes, less those with delta functions: points next to the
// membrane and the mesh they are looked up on, points of the box around it, jumps at the markers.
double sharp_bytes(const Scene& scene) {
  constexpr double of_surface = 126e3, of_box = 12.7e3, of_marker = 990.0;
  double bytes = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const double radius = scene.vesicles[i].radius / scene.spacing(), latitudes = scene.latitudes(i);
    bytes += of_surface * radius * radius + of_box * radius * radius * radius + of_marker * 2.0 * latitudes * latitudes;
  }
  return bytes;
}

// Along each axis a vesicle is 2.5 radii long, more or less, and its band reaches 3.5 spacings further; boxes have room to grow and ghosts, and
// what bands and boxes have to spare makes up for the rest.
double body_box_bytes(const Scene& scene) {
  constexpr double radii = 2.5, more_points = 18.0;
  double bytes = 0.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    if (scene.viscosity_ratio(i) == 1.0) continue;
    const double points = radii * scene.vesicles[i].radius / scene.spacing() + more_points;
    bytes += sizeof(double) * points * points * points;
  }
  return bytes;
}

}  // namespace vesiflow::run
