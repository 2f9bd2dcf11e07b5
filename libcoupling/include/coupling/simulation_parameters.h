// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "coupling/delta_kernel.h"
#include "coupling/export.h"
#include "coupling/marker_motion.h"
#include "coupling/phase_splitting.h"
#include "fluid/elliptic_solver.h"
#include "fluid/navier_stokes.h"
#include "vesicle/coefficients.h"
#include "vesicle/laplace_beltrami.h"
#include "vesicle/membrane.h"
#include "vesicle/mesh_control.h"
#include "vesicle/redistribution.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {

/// How a membrane and the grid of the fluid know of each other.
enum class CouplingMethod {
  delta,  ///< by a regularized delta function, over which the membrane is smeared: of first order in the spacing
  sharp   ///< by the jumps at a membrane without thickness, of second order: docs/jump_conditions.md
};

/// Shapes that a vesicle may start with. The surfaces of `coefficients` and `mesh` are both in
/// VesicleParameters::surface; the two differ in the kind of file that it comes from.
enum class Shape {
  sphere,        ///< vesicle::sphere()
  prolate,       ///< vesicle::prolate()
  oblate,        ///< vesicle::oblate()
  ellipsoid,     ///< vesicle::ellipsoid()
  biconcave,     ///< vesicle::biconcave_disc()
  harmonics,     ///< vesicle::perturbed_sphere()
  coefficients,  ///< vesicle::shape_from_coefficients(), of a file of coefficients
  mesh           ///< vesicle::shape_from_coefficients(), of a surface fitted to a triangle mesh
};
/// When markers are redistributed along a membrane.
enum class Redistribute {
  never,       ///< not at all
  when_needed  ///< when the mesh passes a limit of `mesh`
};
/// The fluid velocity in which markers move through a step.
enum class FluidVelocity {
  frozen,       ///< that of the end of the step
  interpolated  ///< linear in time from the start of the step to its end
};

/// One vesicle as it starts. Lengths are in units of the effective radius of a vesicle of radius 1.
struct VesicleParameters {
  Shape shape = Shape::prolate;                        ///< the shape
  std::optional<double> reduced_volume;                ///< of a prolate or oblate, in [0.3, 1]
  std::optional<double> aspect_ratio;                  ///< of a prolate or oblate: long over short axis, >= 1
  std::optional<std::array<double, 3>> axes;           ///< of an ellipsoid: ratios of its axes along x, y, z
  std::vector<vesicle::Harmonic> harmonics;            ///< terms of a perturbed sphere
  std::optional<vesicle::Coefficients> surface;        ///< of shape = coefficients or mesh
  std::optional<double> viscosity_ratio;               ///< of this vesicle, where it is not fluid.viscosity_ratio
  double radius = 1.0;                                 ///< effective radius (3V/4 pi)^(1/3)
  std::array<double, 3> centre{0.0, 0.0, 0.0};         ///< where it is
  std::array<double, 3> rotation_axis{0.0, 1.0, 0.0};  ///< see rotation_deg
  double rotation_deg = 0.0;                    ///< turns the shape, whose symmetry axis is z, about rotation_axis
  std::optional<double> capillary_number;       ///< of this vesicle, where it is not membrane.capillary_number
  std::optional<double> sigma0;                 ///< of this vesicle, where it is not membrane.sigma0
  std::optional<double> spontaneous_curvature;  ///< of this vesicle, where it is not that of membrane
  std::optional<int> latitudes;                 ///< of this vesicle, where it is not mesh.latitudes
  double density_difference = 0.0;  ///< inside minus outside: gravity pulls with density_difference times acceleration
};

/// All that decides how a simulation computes, beside its flow (coupling/flow.h). Dimensionless groups are the paper's
/// (section 3.1): Re = rho r^2/(mu_o t_c), Ca = mu_o r^3/(c_b t_c). docs/scene.md says what each parameter
/// does, by the name that it has here.
struct VESIFLOW_COUPLING_EXPORT SimulationParameters {
  /// The box and its grid.
  struct Domain {
    std::array<double, 3> lower{-6.0, -6.0, -6.0};      ///< lower corner
    std::array<double, 3> upper{6.0, 6.0, 6.0};         ///< upper corner
    std::array<int, 3> cells{64, 64, 64};               ///< number of cells along each axis
    std::array<bool, 3> periodic{false, false, false};  ///< along which axes the box repeats
    std::array<bool, 3> mirror{false, false, false};    ///< axes at whose lower end is a plane of symmetry, not a wall
  } domain;                                             ///< the box and its grid

  /// The fluid and its solvers.
  struct Fluid {
    double reynolds_number = 1e-3;  ///< Re
    double viscosity_ratio = 1.0;   ///< lambda = mu_i/mu_o of the vesicles that have none of their own

    /// Used where viscosities differ.
    fluid::ViscousTreatment viscous_treatment = fluid::ViscousTreatment::extrapolated;
    fluid::Inertia inertia = fluid::Inertia::full;                     ///< terms of inertia that are kept
    fluid::SolverKind velocity_solver = fluid::SolverKind::automatic;  ///< for the velocity
    fluid::SolverKind pressure_solver = fluid::SolverKind::automatic;  ///< for the pressure
    fluid::Precision precision = fluid::Precision::double_;            ///< of the velocity solve
  } fluid;                                                             ///< the fluid and its solvers

  /// How markers and grid are coupled.
  struct Coupling {
    CouplingMethod method = CouplingMethod::delta;          ///< how a membrane and the grid know of each other
    DeltaKernel kernel = DeltaKernel::smoothed_four_point;  ///< regularized delta function

    /// Whether to add to the velocity of membranes what the width of the kernel takes from it.
    bool thickness_correction = false;
  } coupling;  ///< how markers and grid are coupled

  /// The membranes, where a vesicle does not say otherwise.
  struct Membrane {
    double capillary_number = 2.5;                                         ///< Ca
    double sigma0 = 2000.0;                                                ///< stiffness of the tension
    vesicle::VolumeControl volume = vesicle::VolumeControl::projection;    ///< how the volume is kept
    double volume_stiffness = 1e5;                                         ///< c_v of Eq. (22), for volume = penalty
    double spontaneous_curvature = 0.0;                                    ///< H0, mean of the principal curvatures
    vesicle::TensionLaw tension_law = vesicle::TensionLaw::logarithmic;    ///< how tension follows from strain
    vesicle::TensionForm tension_form = vesicle::TensionForm::divergence;  ///< how its force is discretised
    double integral_rate = 0.0;                                            ///< r of vesicle::IntegralTension; 0: none
    int integral_degrees = vesicle::IntegralTensionParameters{}.degrees;   ///< degrees of the strain that it integrates
    vesicle::AreaControl area = vesicle::AreaControl::none;                ///< how the area is kept, beside the tension
    double area_stiffness = 1e5;                                           ///< c_a, for area = penalty
    vesicle::LaplacianForm laplacian = vesicle::LaplacianForm::cartesian;  ///< formula of Lap H
    vesicle::Upsampling upsampling = vesicle::Upsampling::twice;           ///< how much finer the grid of Lap H is
  } membrane;                                                              ///< the membranes

  /// The meshes of the membranes.
  struct Mesh {
    int latitudes = 32;                                                  ///< N, where a vesicle does not say otherwise
    vesicle::FilterOrder filter = vesicle::FilterOrder::velocity_first;  ///< how marker velocities are filtered
    vesicle::SlipReference slip = vesicle::SlipReference::dealiased;     ///< for the update of target areas
    int normal_degrees = 0;                                 ///< degrees kept in the velocity that shapes; 0: two thirds
    int tangential_degrees = 15;                            ///< degrees kept in the velocity along the membrane
    Redistribute redistribute = Redistribute::when_needed;  ///< when markers are redistributed

    /// Largest vesicle::MeshQuality::aspect_ratio without redistribution.
    double max_aspect_ratio = vesicle::RedistributionLimits{}.aspect_ratio;
    /// Largest vesicle::MeshQuality::spectrum_tail without redistribution.
    double max_spectrum_tail = vesicle::RedistributionLimits{}.spectrum_tail;
  } mesh;  ///< their meshes

  /// Gravity.
  struct Gravity {
    /// G: a vesicle is pulled by density_difference times g per volume inside.
    std::array<double, 3> acceleration{0.0, 0.0, 0.0};
  } gravity;  ///< gravity

  /// Short-range repulsion, see coupling::Repulsion.
  struct Repulsion {
    double range = 0.0;       ///< 0 switches it off
    double strength = 100.0;  ///< pressure between two membranes in contact
    bool walls = true;        ///< whether walls repel too
  } repulsion;                ///< repulsion

  /// Steps and what happens in them.
  struct Time {
    double step = 1.0 / 48.0;                              ///< length of a step
    double end = 8.0;                                      ///< time at which the simulation ends
    MarkerMotion markers = MarkerMotion::shape_following;  ///< how markers move
    double relative_tolerance = 0.0;                       ///< of markers = arkode
    double absolute_tolerance = 1e-6;                      ///< of markers = arkode
    FluidVelocity fluid_velocity = FluidVelocity::frozen;  ///< the velocity in which they move
    double relaxation = 0.25;                              ///< a of markers = strain_relaxation
    double implicit_tolerance = 1e-5;  ///< of markers = implicit: largest change that ends the iteration, in radii
    int implicit_iterations = 100;     ///< and the most evaluations of the coupled problem in a step
    bool adaptive = false;             ///< steps are chosen by their errors; `step` is the first
    double tolerance = 2e-5;      ///< position error per step, root mean square over the markers, in effective radii
    double smallest_step = 1e-5;  ///< of adaptive steps
    double largest_step = 0.1;    ///< of adaptive steps
  } time;                         ///< steps

  /// What a simulation must not pass.
  struct Limits {
    double local_area_error = 0.5;  ///< the simulation stops beyond it

    /// The simulation stops beyond this share of a membrane's velocity that changes from step to step and back.
    double velocity_noise = 0.5;
    double area_error = 1e-3;               ///< relative change of an area that an adaptive step may make
    double volume_error = 1e-3;             ///< relative change of a volume that an adaptive step may make
  } limits;                                 ///< limits
  std::vector<VesicleParameters> vesicles;  ///< the vesicles

  /// Ca of vesicle number i: its own value, or that for all. So are the four that follow.
  double capillary_number(std::size_t i) const;
  double sigma0(std::size_t i) const;                 ///< stiffness of the tension
  double spontaneous_curvature(std::size_t i) const;  ///< H0
  int latitudes(std::size_t i) const;                 ///< N
  double viscosity_ratio(std::size_t i) const;        ///< lambda = mu_i/mu_o

  /// Largest grid spacing: what the grid resolves.
  double spacing() const;
  /// Smallest grid spacing: a delta function of that width answers most to forces, and so decides what is stable.
  double finest_spacing() const;
  /// g = dt sigma0/(4 mu h), the number that decides whether the explicit tension is stable (below 7 to 8), of the
  /// stiffest vesicle and the finest spacing.
  double tension_number() const;
  /// The largest g for which time.markers is stable, cautiously: 7, or 2 with the correction of the thickness, half of
  /// it for ab2, (2 - a)/a times it with strain relaxation, and infinity with shape_following and implicit.
  double stable_tension_number() const;
  /// Least and greatest viscosity, the 1 of the fluid outside included.
  struct ViscosityRange {
    double least = 1.0,                                   ///< least viscosity
        greatest = 1.0;                                   ///< greatest viscosity
    double contrast() const { return greatest / least; }  ///< ratio of the greatest to the least
  };
  ViscosityRange viscosity_range() const;  ///< of this simulation

  /// Whether the viscosity is another one inside some vesicle.
  bool has_viscosity_contrast() const;
  /// Whether there is a field of it, found by an indicator: not where all are equal, and not with sharp membranes.
  bool has_viscosity_field() const;
  /// Whether the fluid is solved for w = mu u instead: sharp membranes between two viscosities.
  bool has_scaled_velocity() const;
  /// Whether the inertia of the two phases is put on the fluid as a force: the same, in a fluid with inertia.
  bool has_phase_inertia() const;
  /// How, where it is.
  PhaseSplitting phase_splitting() const;
  /// Whether a step of length dt solves the fluid a second time, with the forces that implicit terms stand for: sharp
  /// membranes, shape_following, and inertia that matters within a step: its viscous layer, sqrt(dt/Re), is thinner than
  /// the largest vesicle's radius. Otherwise the fluid has forgotten the velocity of the last step, and what it has not heard of
  /// (docs/adr/0010-sharp-membranes.md).
  bool corrects_fluid(double dt) const;
  /// Whether meshes follow the shapes and not the material.
  bool follows_shape() const;
  /// Number of steps of equal length from 0 to time.end, the last one at or just beyond it.
  long steps() const;
};

/// The domain as a grid.
VESIFLOW_COUPLING_EXPORT fluid::Grid grid_of(const SimulationParameters& parameters);
/// The fluid's own parameters, with viscosity 1: a contrast needs the membranes.
VESIFLOW_COUPLING_EXPORT fluid::FluidParameters fluid_parameters_of(const SimulationParameters& parameters);

struct Flow;

/// Checks all of it: the range of each parameter (coupling/parameter_table.h), then what no single one can be blamed
/// for, such as vesicles inside the box, a usable time step, and that they are apart. Simulation does so itself.
/// \throws ParameterError of all mistakes.
VESIFLOW_COUPLING_EXPORT void check(const SimulationParameters& parameters, const Flow& flow);

}  // namespace vesiflow::coupling
