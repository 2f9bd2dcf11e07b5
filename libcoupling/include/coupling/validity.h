// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/export.h"
#include "coupling/simulation_parameters.h"

namespace vesiflow::coupling {

/// Where the method is stable, where it was verified, and what is refused: the one table that the check of parameters,
/// plans, presets of accuracy, advice after a blow-up and the warnings of a run read. docs/stability.md (S) and
/// docs/validation.md (V) have the studies.
/// A run warns where what is named warned_ is passed: errors at which results are no longer those of the parameters.
namespace validity {

constexpr double least_viscosity_ratio = 0.05,  ///< tried in libfluid and here
    greatest_viscosity_ratio = 100.0;           ///< tried in libfluid and here

/// The implicit treatment of viscosity with shape following: quiet to this contrast, while steps of 1/24 blow up at 20
/// (S).
constexpr double quiet_implicit_contrast = 5.0;
/// Errors of the extrapolated treatment of viscosity ring with steps above this over the square root of the contrast
/// (S).
constexpr double extrapolated_step = 0.1;

/// The explicit tension is stable to this g = dt sigma0/(4 mu h) (S; METHOD: growth begins between 7 and 8).
constexpr double stable_g = 7.0;
/// The same with the thickness correction: a thin membrane answers faster than a thick one.
constexpr double stable_g_with_thickness_correction = 2.0;
/// Largest g with the thickness correction.
constexpr double largest_g_with_thickness_correction = 3.0;
/// Share of the stable g that ab2 has: its interval of real stability is half of Euler's.
constexpr double ab2_share_of_g = 0.5;
/// Beyond this many times the stable g a run is not worth starting: a little more than twice.
constexpr double largest_excess_of_g = 16.0 / 7.0;
constexpr double least_inertia = 0.5,  ///< least Reynolds number from which on inertia counts in shape following
    quiet_g_to_one = 112.0,            ///< shape following is quiet to this g from there to Re = 1 (S, inertia)
    quiet_g_above_one = 80.0;          ///< shape following is quiet to this g above Re = 1 (S, inertia)

constexpr double largest_turn_per_step = 0.25;            ///< of a marker: about 15 degrees
constexpr double recommended_turn_per_step = 1.0 / 12.0;  ///< of a marker, with shape following (S)

/// Longest step over Ca: a shape far from rest relaxes at a rate of about 1/Ca (S).
constexpr double bending_step = 0.5;
/// The same of sharp membranes: at Ca = 0.1 noise grows slowly with a step of Ca/2.4 (a run to t = 100 stops at 67), and
/// not with Ca/4.8 (docs/studies/stability_maps.md).
constexpr double bending_step_of_sharp = 0.2;

constexpr double largest_reynolds_number = 10.0;  ///< that has been compared with anything (V)

constexpr double thin_sharp_ratio =
    0.5;  ///< a thinner fluid inside of sharp membranes allows less inertia (docs/coupling.md)

/// To which Reynolds number sharp membranes are quiet with inertia, by the least ratio of viscosities, if that is below
/// thin_sharp_ratio: 1 down to 0.2 (which blows up at 3 on h = R/4), and below that a tenth of the ratio
/// (0.05 and 0.1 blow up at 0.02 and 0.1 in short steps with sigma0 = 20 000; with 2000 they are quiet to Re = ratio).
constexpr double largest_reynolds_number_of_thin_sharp(double least_ratio) {
  return least_ratio < 0.2 ? 0.1 * least_ratio : 1.0;
}

/// To which Reynolds number of a vesicle the inertia of two phases is extrapolated in the cheapest way, of first order in the step: at ratio 5
/// and Re = 5 the angle is off by 3 % with steps of 1/48, and this error falls with Re.
constexpr double slow_reynolds_number_of_phases = 0.1;
/// Above, steps are of second order while viscosities differ by a factor of up to this and none is below thin_sharp_ratio (derived:
/// PhaseInertia::splitting).
constexpr double widest_contrast_of_second_order = 5.0;

/// Sharp membranes in a fluid of a larger Reynolds number than this are quiet on grids of up to
/// most_cells_per_radius_with_inertia_of_sharp spacings per radius (S, tried to 10): with 12, Re = 9 and Ca = 1.2 blows up at ratio 0.6 and grows
/// noisy at 1 and 1.7, whatever step and sigma0; at Re = 5 it is quiet.
constexpr double largest_reynolds_number_of_fine_sharp = 5.0;
/// With more of these, Reynolds numbers above largest_reynolds_number_of_fine_sharp are not.
constexpr double most_cells_per_radius_with_inertia_of_sharp = 8.0;

/// Nearest that a sharp membrane comes to a wall, in spacings: nearer, markers would read points beyond it.
constexpr double sharp_wall_clearance = 1.5;
/// Fewest spacings of the grid per radius of a sharp membrane: with 4 the angle at ratio 5 is within 8 %
/// (docs/jump_conditions.md); with less hardly any degree of its forces is left.
constexpr double fewest_cells_per_radius_of_sharp = 4.0;

/// Sharp membranes of smaller reduced volumes leave noise in the tension at tips and rims, on grids with fewer spacings per
/// radius than below: 0.7 from across a shear flow and at rest, surface divergence 1.7 to 1.8 with 5.3, 0.5 to 0.8 with 8.
constexpr double least_reduced_volume_of_coarse_sharp = 0.75,
                 fewest_cells_per_radius_of_slender_sharp = 8.0;  ///< from which on they may be slender

/// The thickness correction is that of Stokes flow: stable to this Reynolds number, and blows up at 1 (S).
constexpr double largest_reynolds_number_with_thickness_correction = 0.1;

constexpr double least_reduced_volume = 0.64,  ///< of a shape (S, reduced volume and capillary number)
    least_reduced_volume_in_fast_flow = 0.9,   ///< of a shape from fast_capillary_number on (S)
    fast_capillary_number = 10.0;              ///< from which on a flow is fast (S)

constexpr double closest_markers = 0.3,  ///< least distance pi R/latitudes of markers, in spacings of the grid
    widest_markers = 1.25;               ///< greatest distance of markers, in spacings of the grid

/// Fewest spacings of the grid across a vesicle; below, its frequency is off by 5 % and more (V).
constexpr double fewest_cells_across = 8.0;
/// Nearer than this many spacings to each other, or to a wall, membranes have a flow between them that the grid does
/// not resolve.
constexpr double least_resolved_gap = 2.0;
/// Relative error of inclination and frequency in tank-treading per spacing over radius, at ratio 1: 3.5 % at 0.1875
/// (validation/studies/thickening.md).
constexpr double error_per_spacing = 0.19,
                 corrected_error_per_spacing = 0.016;  ///< with the thickness correction: 0.3 % at 0.1875

constexpr double preset_least_capillary_number = 1.0,  ///< presets of accuracy are verified from this on
    preset_least_reduced_volume = 0.8;                 ///< and from this on (docs/performance.md)

constexpr double warned_area_error = 1e-2,  ///< relative error of an area
    warned_volume_error = 1e-3,             ///< relative error of a volume
    warned_local_area_error = 5e-2,         ///< relative error of a surface element
    warned_surface_divergence = 0.1,        ///< divergence of a membrane's velocity along the membrane
    warned_spectrum_tail = 1e-4,            ///< share of the energy of positions in the highest degrees
    warned_unresolved_bending = 0.05,       ///< share of Lap H that is not resolved
    warned_velocity_noise = 0.05,           ///< share of a membrane's velocity that changes from step to step and back
    warned_courant_number = 2.0,            ///< of a membrane: its speed times the step over the spacing
    warned_divergence = 1e-8;               ///< of the fluid

constexpr long settling_steps = 10;  ///< of a start, in which velocities jump

}  // namespace validity

/// The longest step that follows bending: validity::bending_step, or bending_step_of_sharp, times the smallest Ca r^3 of
/// the vesicles.
VESIFLOW_COUPLING_EXPORT double stable_bending_step(const SimulationParameters& parameters);

/// The largest g = dt sigma0/(4 h) at which shape following is quiet where inertia counts (docs/time_integration.md,
/// shape_following); infinite elsewhere.
VESIFLOW_COUPLING_EXPORT double quiet_tension_number(const SimulationParameters& parameters);

/// Largest time step at which the explicit convection of the flow is stable (fluid::stable_convection_step); infinite
/// without inertia, and where nothing is known of the flow.
VESIFLOW_COUPLING_EXPORT double stable_convection_step(const SimulationParameters& parameters, const Flow& flow);

/// Greatest effective radius of the vesicles: what lengths are large or small against.
VESIFLOW_COUPLING_EXPORT double largest_radius(const SimulationParameters& parameters);

/// Reynolds number of the largest vesicle in the unit of time: rho r^2/(mu t), whatever the unit of length. 0 without
/// inertia.
VESIFLOW_COUPLING_EXPORT double vesicle_reynolds_number(const SimulationParameters& parameters);
/// Whether there is more inertia than sharp membranes around a thinner fluid are quiet with, if the membranes are sharp.
VESIFLOW_COUPLING_EXPORT bool passes_inertia_of_thin_sharp(const SimulationParameters& parameters);
/// Whether sharp membranes would have more inertia than such fine grids allow.
VESIFLOW_COUPLING_EXPORT bool passes_inertia_of_fine_sharp(const SimulationParameters& parameters);

/// Capillary number of a vesicle in the unit of time and its own radius: mu r^3/(c_b t), whatever the unit of length.
VESIFLOW_COUPLING_EXPORT double own_capillary_number(const SimulationParameters& parameters, std::size_t vesicle);

}  // namespace vesiflow::coupling
