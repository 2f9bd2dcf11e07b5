// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/quantities.h"

#include <array>

namespace vesiflow::run {
namespace {

constexpr std::array of_vesicles = {
    Quantity{"inclination_angle_deg", "inclination", "degrees", "motion"},
    Quantity{"tank_treading_frequency", "tank-treading frequency", "1/time", "motion"},
    Quantity{"centroid_x", "centroid x", "r", "motion"},
    Quantity{"centroid_y", "centroid y", "r", "motion"},
    Quantity{"centroid_z", "centroid z", "r", "motion"},
    Quantity{"min_distance", "least distance to another", "r", "motion"},
    Quantity{"deformation", "deformation (L - S)/(L + S)", "", "shape"},
    Quantity{"semi_axis_1", "longest semi-axis", "r", "shape"},
    Quantity{"semi_axis_2", "middle semi-axis", "r", "shape"},
    Quantity{"semi_axis_3", "shortest semi-axis", "r", "shape"},
    Quantity{"reduced_volume", "reduced volume", "", "shape"},
    Quantity{"excess_area", "excess area", "", "shape"},
    Quantity{"area", "area", "r²", "shape"},
    Quantity{"volume", "volume", "r³", "shape"},
    Quantity{"bending_energy", "bending energy", "1/2 ∫H² dA", "energy and tension"},
    Quantity{"elastic_energy", "elastic energy", "", "energy and tension"},
    Quantity{"tension_min", "least tension", "μ r/time", "energy and tension"},
    Quantity{"tension_max", "greatest tension", "μ r/time", "energy and tension"},
    Quantity{"area_error", "error of the area", "relative", "errors"},
    Quantity{"volume_error", "error of the volume", "relative", "errors"},
    Quantity{"max_local_area_error", "greatest local area error", "relative", "errors"},
    Quantity{"max_label_area_error", "greatest label area error", "relative", "errors"},
    Quantity{"surface_divergence_max", "greatest surface divergence", "1/time", "errors"},
    Quantity{"spectrum_tail", "spectrum tail", "share", "mesh"},
    Quantity{"unresolved_bending", "unresolved bending", "share", "mesh"},
    Quantity{"needed_latitudes", "needed latitudes", "", "mesh"},
    Quantity{"mesh_aspect_ratio", "mesh aspect ratio", "", "mesh"},
    Quantity{"mesh_area_ratio", "mesh area ratio", "", "mesh"},
    Quantity{"redistributions", "redistributions of the markers", "", "mesh"},
    Quantity{"marker_sub_steps", "sub-steps of the markers", "", "mesh"},
    Quantity{"marker_rejected_sub_steps", "sub-steps repeated", "", "mesh"},
    Quantity{"marker_evaluations", "evaluations of the markers' velocity", "", "mesh"}};

constexpr std::array of_errors = {
    Quantity{"area", "area", "relative", "Change of the area of a whole vesicle."},
    Quantity{"volume", "volume", "relative", "Change of the volume of a whole vesicle."},
    Quantity{"local_area", "local area", "relative",
             "How far a piece of membrane is off the area that it should keep."},
    Quantity{"surface_divergence", "surface divergence", "1/time",
             "What strains the membrane; an inextensible one has none."},
    Quantity{"spectrum_tail", "spectrum tail", "share", "Energy of the shape in the top third of the degrees."},
    Quantity{"unresolved_bending", "unresolved bending", "share",
             "Share of the bending force beyond the degrees of the mesh."},
    Quantity{"velocity_noise", "velocity noise", "share",
             "What of the membrane's velocity changes from step to step and back."},
    Quantity{"courant_number", "Courant number", "",
             "Time step times the greatest speed of a membrane over the spacing."},
    Quantity{"membrane_gap", "least gap between membranes", "spacings",
             "Below 2 the fluid in between is not resolved."},
    Quantity{"wall_gap", "least gap to a wall", "spacings", "Below 2 the fluid in between is not resolved."},
    Quantity{"divergence", "divergence", "1/time", "Greatest divergence of the fluid's velocity."}};

}  // namespace

std::span<const Quantity> vesicle_quantities() {
  return of_vesicles;
}
std::span<const Quantity> error_quantities() {
  return of_errors;
}

Quantity quantity_of(std::span<const Quantity> all, std::string_view name) {
  for (const Quantity& quantity : all)
    if (quantity.name == name) return quantity;
  return {.name = name, .label = name, .unit = "", .group = "others"};
}

}  // namespace vesiflow::run
