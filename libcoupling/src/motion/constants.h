// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

/// Every constant of how membranes move, with what it is derived from or the study that found it, and how flat its
/// optimum is. docs/adr/0006 (`ADR 6` below) tells of the trials; where only one other value was seen, it says which.
namespace vesiflow::coupling::constants {

// --- Degrees that shape following keeps (motion/following_parameters.h)

/// Waves of degree n have the wavenumber n/R on a sphere: those of k h < 0.7 pi are resolved, n < 0.7 pi R/h. ADR 6,
/// validation/studies/integrators.md: with 0.95 pi (and a damping of 8) waves of degree 30 to 34 at the tips doubled every
/// 0.85 units of time at 128^3.
inline constexpr double largest_resolved_kh = 0.7 * std::numbers::pi;
/// Of a sharp membrane: above, no variant of the jump corrections resolves what a force of this degree does, and the
/// two-phase iteration has an eigenvalue beyond -1 (docs/jump_conditions.md).
inline constexpr double largest_resolved_kh_of_sharp_membrane = 1.5;
/// An ellipsoid has degrees up to 2, a pear 3: fewer are no shape.
inline constexpr int fewest_degrees = 4;

// --- Damping of the highest degrees (motion/wave_damping.h)

/// The highest degree p - 1 decays at this many times the rate U/R at which the membrane is swept along, degree n by
/// (n/(p - 1))^8 of it: waves near the resolution of the grid, which the fluid hardly feels, would otherwise grow.
/// validation/studies/integrators.md: half of it is too little (with 0.95 pi above). The power leaves half of the degrees
/// with less than 1/256 of the rate.
inline constexpr double damping_of_highest_degree = 16.0;
inline constexpr int damping_power = 8;

// --- The implicit slip (motion/increment_solver.h)
//
// A membrane that slips over its mesh at the speed U sweeps waves of degree n by n U/R: the operator of the solve is
// 1 + i c with |c| <= dt U n/(3/2 R), less where waves are stiff or damped. From Chebyshev polynomials on that segment
// the residual of GMRES after k iterations is rho^k, rho = c/(1 + sqrt(1 + c^2)), to a factor of two
// (tests/coupling/motion/increment_solver_test.cpp).

/// Of the right-hand side, which is a second difference of the path. Prolates in shear (reduced volume 0.9 at Ca = 2.5
/// and, with a ratio of 10, at Ca = 30; 0.7 at Ca = 2.5; 24^3 to 64^3 cells in [-3,3]^3; dt = 1/6 to 1/48; t =
/// 0.5 to 4) were computed with 1e-12 and with 1e-1, 1e-2, 1e-3, 1e-4: they end off by up to 13, 4, 0.4 and 0.07 per
/// cent of what half the step changes, for at most 1, 3, 4 and 5 iterations of a solve. So the value is flat, and 1e-4
/// the first that is nothing beside the step.
inline constexpr double slip_tolerance = 1e-4;
/// What is accepted where the tolerance is not reached within the iterations below: in the study above still 4 per cent
/// of the error of the step.
inline constexpr double worst_slip_residual = 1e-2;
/// Bounds the memory of the Krylov space. Where dt U n/R = 2 pi for the highest degree, the shortest waves are swept
/// over one of their lengths in a step: there 40 iterations reach 7e-5, the tolerance. Over two of their lengths they
/// reach 7e-3; a step that is longer follows no wave, and says so.
inline constexpr int most_slip_iterations = 40;

// --- Velocity of the mesh (motion/mesh_motion.h)

/// While the membrane moves by its radius the mesh relaxes this many times. ADR 6: at reduced volume 0.7 rates of
/// 0.25 to 4 times the shear rate are alike in noise and steady state.
inline constexpr double mesh_relaxation = 1.0;
/// But no faster than by this share in a step. Steepest descent in the norm of the energy has eigenvalues above 1, so
/// that a third in a step is unstable (Ca = 30; ADR 6).
inline constexpr double largest_mesh_relaxation = 0.1;
/// The mesh turns at this many times the membrane's greatest speed over its radius at most. A shape that deviates by
/// f from a sphere turns at about 1/f of the rate of strain when its axes change: no material does, and a mesh that
/// turns by an angle a in a step is off by a^2/2. From a reduced volume of 0.99 down shapes turn by less than 3 times
/// (from 0.9 down by 1.1; ADR 6).
inline constexpr double fastest_turning = 3.0;

// --- Area and volume (motion/shape_conservation.h, motion/mean_strain.h)

/// Directions of the conserving displacements. ADR 6: with 16 degrees what they add to the shape feeds on itself and
/// limits the step at 128^3, with all of them noise is multiplied by 50 in a step; 5 do not.
inline constexpr int degrees_of_corrections = 5;
/// Mean strain that is held at the area A0, over the excess area. ADR 6: 1 (the elastic sphere), 4 and 10 are alike
/// but for where the area begins to give way; there the strain is the cube root of this times that of an elastic
/// sphere.
inline constexpr double held_strain_per_excess = 4.0;
/// Root mean square of the normal velocity of a sphere in shear that no tension holds, over radius and rate of shear.
/// The undisturbed flow has R <(n_x n_z)^2>^(1/2) = R/sqrt(15) along the normal, of which an area-preserving sphere
/// answers with 60/(23 ratio + 32) (quasi-spherical vesicles: Misbah 2006, doi:10.1103/PhysRevLett.96.028104):
/// 60/55/sqrt(15) = 0.28 for equal viscosities. It decides an order of magnitude only.
inline constexpr double normal_share_of_shear = 0.28;
/// The share of the curvature that varies is twice the excess area of a nearly spherical shape; below this it is
/// round-off of the geometry. Any value between that, about 1e-14, and what is worth keeping does the same.
inline constexpr double smallest_independence = 1e-9;

// --- Stiffness: how much Z is more than the rates of MembraneResponse (motion/stiffness.h)

/// On a mode that relaxes at z/dt, BDF2 in increments with Z has the recurrence (3/2 + Z)(q^2 - q) = (1/2 + Z)(q - 1)
/// - z (2 q - 1), whose root reaches q = -1 where 4 + 4 Z = 3 z: Z must be at least 3/4 of the true rate. 1.5 is
/// twice that, for what the estimate does not know of tips and rims. ADR 6: three times too much costs a little
/// damping only.
inline constexpr double overestimate = 1.5;
/// Where inertia dominates the response: by trial, 1.5 is unstable there at Re = 1.
inline constexpr double overestimate_with_inertia = 3.0;
/// With the correction of the thickness the overestimate is multiplied by this power of the greatest compression of
/// the mesh, as waves of a degree are so much shorter at the tips and the membrane now answers to them: without it
/// reduced volumes 0.65 and 0.7 stop (h = 0.1); 3 instead of 1.5 and the power stops at 0.8 off the axis of a
/// Poiseuille flow (h = 0.05, t = 1.7).
inline constexpr int compression_power_of_thin_membrane = 2;
/// More where part of the viscosity is explicit: this times the explicit share of the solved viscosity times what the
/// solved one is above 1, which makes 30 in all at ratio 20 and 7 at 5. ADR 6: three times with half of the memory
/// (below) are quiet from ratio 2.7 to 50 and h = 0.1 to 0.19; one time with 0.6 to 1, and two times with 0.5 to 1,
/// make noise in some of them. The price is errors of the step 1.3 to 2 times larger (still of second order). A thin
/// or pointed end has less of the inner fluid around it than the half that the model gives it.
inline constexpr double overestimate_per_ratio = 3.0;
/// Share of what the explicit term owes to velocities that the fluid never had which is handed to it. With an
/// overestimate of 10 and all of it noise grows by 1.3 in a step (128^3, ratio 5, dt = 1/24), with 10 and 0.8 of it a
/// tank-treading vesicle of reduced volume 0.8 at ratio 6 stops at t = 13 (h = 0.1, dt = 1/32): surface divergence
/// 0.1 to 0.2 there at t = 8, against 0.001 with these.
inline constexpr double viscous_memory = 0.5;
/// The two for a fluid that is thinner inside: 9 in all at ratio 0.05. What an extrapolated viscosity leaves in the
/// fluid decays at 5 times the shear rate there whatever the step, so that short steps see many of their past
/// corrections and small errors of the answers feed on themselves: with 3 in all noise grows at 4 to 9 times the
/// shear rate from round-off at steps of 1/96 and 1/192 (stop at t = 4 to 7), with 7 at 1.5 times at 1/96, with 9 it
/// falls at 1/48 to 1/384. At 1/24 it falls for ratio 0.2 and grows slowly for 0.05, where the plan warns of that
/// step (11 stops there). With half of the memory ratio 0.05 makes noise at 1/48; all of it is worse at 1/24, and
/// quiet at 1/96 and 1/192 within 5 % of it only (ADR 6).
inline constexpr double overestimate_of_thin_fluid = 16.0;
inline constexpr double memory_of_thin_fluid = 0.8;
/// Of markers = implicit, where Z has no part in the answer: what takes the fewest evaluations. 3 to 10, as stability
/// asks for above, takes up to twice as many (docs/time_integration.md).
inline constexpr double overestimate_of_implicit_motion = 0.75;

// --- The force that is owed to the fluid (motion/owed_force.h)

/// Where a membrane is curved as strongly as its viscous layer (of thickness delta, delta^2 = mu/a) is thick, the
/// fluid remembers less than around a plane sheet: 1/(1 + (4 delta H)^2) of it, H being the greatest mean curvature.
/// At sigma0 = 2000 all of it is unstable at the rim of an ellipsoid 3:3:1 (Re = 1, 64^3, at any step), 0.6 of it is
/// not; around a prolate of reduced volume 0.9 (Re = 10, 24^3, dt = 1/48) noise grows with 0.7 of it. ADR 6: 1/(1 + 2
/// delta H) and a floor of 0.4 or 0.5 were worse.
inline constexpr double layers_of_curvature = 4.0;

// --- Local error (motion/path_error.h)

/// BDF2 leaves dt^3 X'''/3 in 3/2 y - 2 y^k + 1/2 y^{k-1} = dt f: 2/9 of dt^3 X''' in y.
inline constexpr double bdf2_error = 2.0 / 9.0;

// --- Fixed point of the implicit step (motion/fixed_point.h)

/// Of Anderson acceleration. docs/time_integration.md: with 10 a stiff membrane stopped converging at t = 0.15, with
/// 20 it did not.
inline constexpr int remembered_iterates = 20;

// --- Sub-steps of the markers (motion/arkode_integrator.cpp)

/// The pair of Bogacki and Shampine: of the lowest order that is above the coupling's own, at three evaluations for a
/// sub-step (docs/time_integration.md).
inline constexpr int order_of_arkode = 3;

// --- Answer of a membrane in a plane sheet (motion/membrane_response.h)

/// Exponents c of exp(-c (k h)^2), what the delta function takes off the answer within the sheet. On spheres it was
/// measured to be 0.35 (to 15 %, for k h of 0.3 to 2 and Re/dt up to 480). The velocity overestimates the answer on
/// purpose.
inline constexpr double in_plane_decay = 0.1;
/// What makes up for a velocity that the fluid never had is in inverse proportion to the true answer; 1.4 times too
/// much is unstable, half of it is not: hence 0.2.
inline constexpr double in_plane_decay_of_owed = 0.2;
/// Points of the quadrature in the angle atan(k_z/k): errors below 1e-3
/// (tests/coupling/motion/membrane_response_test.cpp).
inline constexpr int response_quadrature_points = 200;
/// Places of a sheet between two points of the grid, midpoint rule: 64 change the means by less than 2e-3 of them.
inline constexpr int positions_of_sheet = 16;
/// Means of f_i^2 n_i^2, summed, over the orientations of a sheet of normal n: 3/5 for f = n, and 1/5 for f normal to
/// n.
inline constexpr double normal_share_of_normal_force = 0.6;
inline constexpr double normal_share_of_force_along = 0.2;

// --- Answer of a spherical membrane (motion/sphere_response.h)

/// Times h: the answer beyond it is below 1e-5 of the whole.
inline constexpr double largest_sphere_wavenumber = 4.0 * std::numbers::pi;
/// Of the tables of the delta function's Fourier transform, in wavenumbers times h, and the points per h that it is
/// made of.
inline constexpr double transform_spacing = 0.01;
inline constexpr int transform_points_per_spacing = 200;
/// Points in cos(theta) and in phi for the mean over an octant of directions.
inline constexpr int directions_per_octant = 16;
/// Steps of q R. Products of Bessel functions have the period pi in it, and everything is even and smooth: the
/// midpoint rule converges fast.
inline constexpr double steps_per_radian = 2.0;

// --- Starts in parts (motion/start_control.h); changes of the shape in a step, docs/time_integration.md, "Starts far
// from rest"

/// From across a shear flow with dt = 1/24 first steps below it leave no noise (reduced volume 0.7 at Ca = 2.5:
/// 0.16), those above do (0.8 at Ca = 0.5: 0.43, 0.7: 0.5 to 0.9; docs/stability.md).
inline constexpr double largest_first_change = 0.2;
/// Of parts: with 0.025 to 0.05 and 8 calm parts the surface divergence of the oblate of 0.7 at Ca = 0.5 (h = R/8) is
/// 0.06 after four steps, 0.22 with twice as much and half as many calm parts. With 2 calm parts the growing parts
/// themselves make noise (0.4).
inline constexpr double largest_part_change = 0.05;
inline constexpr double calm_part_change = 0.25 * largest_part_change;
inline constexpr int calm_parts_to_grow = 8;
/// After so many steps parts grow whatever the shapes do: what is fast for long is no start. Two units of time at
/// steps of 1/24.
inline constexpr long longest_start = 48;
/// Parts are no shorter than 2^-10 of a step, a thousandth.
inline constexpr int finest_part_level = 10;

}  // namespace vesiflow::coupling::constants
