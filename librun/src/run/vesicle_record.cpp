// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/vesicle_record.h"

#include <numbers>

namespace vesiflow::run {

void visit_record(const vesicle::Diagnostics& d,
                  const std::function<void(std::string_view, const double*, int)>& visit) {
  const auto number = [&](std::string_view name, double value) { visit(name, &value, 1); };
  number("inclination_angle_deg", d.inclination_angle * 180.0 / std::numbers::pi);
  number("tank_treading_frequency", d.tank_treading_frequency);
  number("area_error", d.area_error);
  number("volume_error", d.volume_error);
  number("max_local_area_error", d.max_local_area_error);
  number("max_label_area_error", d.max_label_area_error);
  number("surface_divergence_max", d.surface_divergence_max);
  number("bending_energy", d.bending_energy);
  number("elastic_energy", d.elastic_energy);
  number("reduced_volume", d.reduced_volume);
  number("excess_area", d.excess_area);
  number("deformation", d.deformation);
  number("area", d.area);
  number("volume", d.volume);
  visit("centroid", d.centroid.data(), 3);
  visit("semi_axes", d.semi_axes.data(), 3);
  number("tension_min", d.tension_min);
  number("tension_max", d.tension_max);
  number("spectrum_tail", d.spectrum_tail);
  number("unresolved_bending", d.resolution.unresolved);
  number("needed_latitudes", d.resolution.needed_latitudes);
  number("mesh_aspect_ratio", d.mesh_aspect_ratio);
  number("mesh_area_ratio", d.mesh_area_ratio);
}

}  // namespace vesiflow::run
