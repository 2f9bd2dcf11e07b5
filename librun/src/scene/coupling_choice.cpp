// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/coupling_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "coupling/delta_kernel.h"
#include "coupling/initial_shape.h"
#include "coupling/validity.h"
#include "vesicle/shapes.h"
#include "vesicle/surface.h"

namespace vesiflow::run {
namespace {

namespace validity = coupling::validity;
using coupling::CouplingMethod;

// Of the smallest vesicle.
bool has_cells_per_radius(const Scene& scene, double least) {
  constexpr double round_off = 1e-9;
  return std::ranges::all_of(scene.vesicles, [&](const coupling::VesicleParameters& vesicle) {
    return vesicle.radius >= least * scene.spacing() * (1.0 - round_off);
  });
}

double least_reduced_volume(const Scene& scene) {
  constexpr int latitudes = 24;  // to 2e-3
  double least = 1.0;
  for (const coupling::VesicleParameters& vesicle : scene.vesicles) {
    vesicle::Surface surface(latitudes);
    surface.update(coupling::initial_markers(vesicle, latitudes));
    least = std::min(least, vesicle::reduced_volume(surface.area(), surface.volume()));
  }
  return least;
}

// Where the inertia of two phases blows up: docs/coupling.md#sharp-membranes.
std::string limit_of_inertia(const Scene& scene) {
  if (coupling::passes_inertia_of_fine_sharp(scene))
    return fmt::format("with such inertia, sharp membranes can blow up on grids with more than {:g} cells per radius",
                       coupling::validity::most_cells_per_radius_with_inertia_of_sharp);
  if (!coupling::passes_inertia_of_thin_sharp(scene)) return "";
  return fmt::format("with such inertia, sharp membranes around a fluid of ratio {:g} blow up",
                     scene.viscosity_range().least);
}

}  // namespace

std::string why_delta(const Scene& scene) {
  if (scene.method.preset == Preset::paper) return "it is the paper's, as method.preset = \"paper\"";
  if (!scene.follows_shape())
    return fmt::format("time.markers = \"{}\" knows no sharp membranes", coupling::name(scene.time.markers));
  if (scene.coupling.thickness_correction)
    return "coupling.thickness_correction = true, the cheapest way to a small error in slow flow at equal viscosities";
  const bool has_walls = std::ranges::any_of(scene.domain.periodic, [](bool periodic) { return !periodic; });
  if (has_walls && coupling::wall_clearance(scene.coupling.kernel) < validity::sharp_wall_clearance)
    return fmt::format("coupling.kernel = \"{}\" lets membranes come nearer to walls than sharp ones may",
                       coupling::name(scene.coupling.kernel));
  if (!has_cells_per_radius(scene, validity::fewest_cells_per_radius_of_sharp))
    return fmt::format("fewer than {:g} cells per radius are too few for sharp membranes",
                       validity::fewest_cells_per_radius_of_sharp);
  if (!has_cells_per_radius(scene, validity::fewest_cells_per_radius_of_slender_sharp) &&
      least_reduced_volume(scene) < validity::least_reduced_volume_of_coarse_sharp)
    return fmt::format(
        "with fewer than {:g} cells per radius, tips and rims of sharp membranes of reduced volumes below {:g} are "
        "not resolved",
        validity::fewest_cells_per_radius_of_slender_sharp, validity::least_reduced_volume_of_coarse_sharp);
  return limit_of_inertia(scene);
}

void choose_coupling_method(Scene& scene) {
  try {
    scene.coupling.method = why_delta(scene).empty() ? CouplingMethod::sharp : CouplingMethod::delta;
  } catch (const std::exception&) {
    scene.coupling.method = CouplingMethod::delta;  // of a shape that the check of the scene refuses
  }
}

std::string describe_coupling_method(const Scene& scene) {
  const std::string why = why_delta(scene);
  if (scene.coupling.method == CouplingMethod::sharp)
    return why.empty() ? "sharp: its error is of second order in the spacing"
                       : "sharp, as asked for, though \"delta\" would be chosen: " + why;
  return why.empty() ? "delta, as asked for: \"sharp\" would have an error of second order in the spacing"
                     : "delta: " + why;
}

}  // namespace vesiflow::run
