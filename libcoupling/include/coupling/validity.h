// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coupling/export.h"
#include "coupling/simulation_parameters.h"

namespace vesiflow::coupling {

/// Where the method is stable, where it was verified, and what is refused: the one table that the check of parameters, plans, presets of
/// accuracy, advice after a blow-up and the warnings of a run read. docs/stability.md (S) and docs/validation.md (V) have the studies.
namespace validity {

// Viscosity.
constexpr double least_viscosity_ratio = 0.05, greatest_viscosity_ratio = 100.0;  ///< tried in libfluid and here
/// The implicit treatment with shape following: quiet to this contrast, while steps of 1/24 blow up at 20 (S).
constexpr double quiet_implicit_contrast = 5.0;
/// Errors of the extrapolated treatment ring with steps above this over the square root of the contrast (S).
constexpr double extrapolated_step = 0.1;

// The explicit tension, by g = dt sigma0/(4 mu h) (S; METHOD: growth begins between 7 and 8).
constexpr double stable_g = 7.0;
constexpr double stable_g_with_thickness_correction = 2.0;  ///< a thin membrane answers faster than a thick one
constexpr double largest_g_with_thickness_correction = 3.0;
constexpr double ab2_share_of_g = 0.5;  ///< its interval of real stability is half of Euler's
/// Beyond this many times the stable g a run is not worth starting: a little more than twice.
constexpr double largest_excess_of_g = 16.0 / 7.0;
/// Shape following, where inertia counts: quiet to these g at Reynolds numbers from the first to 1, and above (S, inertia).
constexpr double least_inertia = 0.5, quiet_g_to_one = 112.0, quiet_g_above_one = 80.0;

// The step.
constexpr double largest_turn_per_step = 0.25;            ///< of a marker: about 15 degrees
constexpr double recommended_turn_per_step = 1.0 / 12.0;  ///< with shape following (S)
constexpr double bending_step = 0.5;  ///< times Ca: a shape far from rest relaxes at a rate of about 1/Ca (S)

// The flow.
constexpr double largest_reynolds_number = 10.0;  ///< that has been compared with anything (V)
/// The thickness correction is that of Stokes flow: stable to this, and blows up at 1 (S).
constexpr double largest_reynolds_number_with_thickness_correction = 0.1;

// Shapes (S, reduced volume and capillary number).
constexpr double least_reduced_volume = 0.64, least_reduced_volume_in_fast_flow = 0.9, fast_capillary_number = 10.0;

// Resolution.
constexpr double closest_markers = 0.3, widest_markers = 1.25;  ///< in spacings of the grid: pi R/latitudes
constexpr double fewest_cells_across = 8.0;  ///< of a vesicle; below, its frequency is off by 5 % and more (V)
/// Nearer than this many spacings to each other, or to a wall, membranes have a flow between them that the grid does not resolve.
constexpr double least_resolved_gap = 2.0;
/// Relative error of inclination and frequency in tank-treading per spacing over radius, at ratio 1: 3.5 % at 0.1875, and 0.3 %
/// with the thickness correction (validation/thickening.md).
constexpr double error_per_spacing = 0.19, corrected_error_per_spacing = 0.016;

// What presets of accuracy were verified for (docs/performance.md#presets).
constexpr double preset_least_capillary_number = 1.0, preset_least_reduced_volume = 0.8;

// What a run warns of when it is passed: errors at which results are no longer those of the scene.
constexpr double warned_area_error = 1e-2, warned_volume_error = 1e-3, warned_local_area_error = 5e-2,
                 warned_surface_divergence = 0.1, warned_spectrum_tail = 1e-4, warned_unresolved_bending = 0.05,
                 warned_velocity_noise = 0.05, warned_courant_number = 2.0, warned_divergence = 1e-8;
constexpr long settling_steps = 10;  ///< of a start, in which velocities jump

}  // namespace validity

/// The longest step that follows bending: validity::bending_step times the smallest Ca r^3 of the vesicles.
VESIFLOW_COUPLING_EXPORT double stable_bending_step(const SimulationParameters& parameters);

/// The largest g = dt sigma0/(4 h) at which shape following is quiet where inertia counts (docs/time_integration.md, shape_following); infinite
/// elsewhere.
VESIFLOW_COUPLING_EXPORT double quiet_tension_number(const SimulationParameters& parameters);

/// Largest time step at which the explicit convection of the flow is stable (fluid::stable_convection_step); infinite without
/// inertia, and where nothing is known of the flow.
VESIFLOW_COUPLING_EXPORT double stable_convection_step(const SimulationParameters& parameters, const Flow& flow);

/// Greatest effective radius of the vesicles: what lengths are large or small against.
VESIFLOW_COUPLING_EXPORT double largest_radius(const SimulationParameters& parameters);

/// Reynolds number of the largest vesicle in the unit of time: rho r^2/(mu t), whatever the unit of length. 0 without inertia.
VESIFLOW_COUPLING_EXPORT double vesicle_reynolds_number(const SimulationParameters& parameters);

/// Capillary number of a vesicle in the unit of time and its own radius: mu r^3/(c_b t), whatever the unit of length.
VESIFLOW_COUPLING_EXPORT double own_capillary_number(const SimulationParameters& parameters, std::size_t vesicle);

}  // namespace vesiflow::coupling
