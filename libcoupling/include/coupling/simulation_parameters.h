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
#include "fluid/elliptic_solver.h"
#include "fluid/navier_stokes.h"
#include "vesicle/coefficients.h"
#include "vesicle/laplace_beltrami.h"
#include "vesicle/membrane.h"
#include "vesicle/mesh_control.h"
#include "vesicle/redistribution.h"
#include "vesicle/shapes.h"

namespace vesiflow::coupling {

/// Shapes that a vesicle may start with. The surfaces of `coefficients` and `mesh` are both in VesicleParameters::surface; the two
/// differ in the file that a scene names for them.
enum class Shape { sphere, prolate, oblate, ellipsoid, biconcave, harmonics, coefficients, mesh };
enum class Redistribute { never, when_needed };
/// The fluid velocity in which markers move through a step: that of its end, or linear in time from its start to its end.
enum class FluidVelocity { frozen, interpolated };

/// One vesicle as it starts. Lengths are in units of the effective radius of a vesicle of radius 1.
struct VesicleParameters {
  Shape shape = Shape::prolate;
  std::optional<double> reduced_volume;          ///< of a prolate or oblate, in [0.3, 1]
  std::optional<double> aspect_ratio;            ///< of a prolate or oblate: long over short axis, >= 1
  std::optional<std::array<double, 3>> axes;     ///< of an ellipsoid: ratios of its axes along x, y, z
  std::vector<vesicle::Harmonic> harmonics;      ///< terms of a perturbed sphere
  std::optional<vesicle::Coefficients> surface;  ///< of shape = coefficients or mesh
  std::optional<double> viscosity_ratio;         ///< of this vesicle, where it is not fluid.viscosity_ratio
  double radius = 1.0;                           ///< effective radius (3V/4 pi)^(1/3)
  std::array<double, 3> centre{0.0, 0.0, 0.0};
  std::array<double, 3> rotation_axis{0.0, 1.0, 0.0};
  double rotation_deg = 0.0;  ///< turns the shape, whose symmetry axis is z, about rotation_axis
  // The vesicle's own, in the place of what membrane and mesh say for all.
  std::optional<double> capillary_number;
  std::optional<double> sigma0;
  std::optional<double> spontaneous_curvature;
  std::optional<int> latitudes;
  double density_difference = 0.0;  ///< inside minus outside: gravity pulls with density_difference times acceleration
};

/// All that decides how a simulation computes, beside its flow (coupling/flow.h). Dimensionless groups are the paper's (section 3.1):
/// Re = rho r^2/(mu_o t_c), Ca = mu_o r^3/(c_b t_c). Scene files have keys of the same names (docs/scene.md).
struct VESIFLOW_COUPLING_EXPORT SimulationParameters {
  struct Domain {
    std::array<double, 3> lower{-6.0, -6.0, -6.0};
    std::array<double, 3> upper{6.0, 6.0, 6.0};
    std::array<int, 3> cells{64, 64, 64};
    std::array<bool, 3> periodic{false, false, false};  ///< along which axes the box repeats
    std::array<bool, 3> mirror{false, false, false};    ///< axes at whose lower end is a plane of symmetry, not a wall
  } domain;
  struct Fluid {
    double reynolds_number = 1e-3;
    double viscosity_ratio = 1.0;  ///< lambda = mu_i/mu_o of the vesicles that have none of their own
    fluid::ViscousTreatment viscous_treatment = fluid::ViscousTreatment::extrapolated;
    fluid::Inertia inertia = fluid::Inertia::full;
    fluid::SolverKind velocity_solver = fluid::SolverKind::automatic;
    fluid::SolverKind pressure_solver = fluid::SolverKind::automatic;
  } fluid;
  struct Coupling {
    DeltaKernel kernel = DeltaKernel::smoothed_four_point;
    bool thickness_correction =
        false;  ///< adds to the velocity of membranes what the width of the kernel takes from it
  } coupling;
  struct Membrane {
    double capillary_number = 2.5;
    double sigma0 = 2000.0;
    vesicle::VolumeControl volume = vesicle::VolumeControl::projection;
    double volume_stiffness = 1e5;       ///< c_v of Eq. (22), for volume = penalty
    double spontaneous_curvature = 0.0;  ///< H0, mean of the principal curvatures
    vesicle::TensionLaw tension_law = vesicle::TensionLaw::logarithmic;
    vesicle::TensionForm tension_form = vesicle::TensionForm::divergence;
    double integral_rate = 0.0;  ///< r of vesicle::IntegralTension; 0: none
    int integral_degrees = vesicle::IntegralTensionParameters{}.degrees;
    vesicle::AreaControl area = vesicle::AreaControl::none;
    double area_stiffness = 1e5;  ///< c_a, for area = penalty
    vesicle::LaplacianForm laplacian = vesicle::LaplacianForm::cartesian;
    vesicle::Upsampling upsampling = vesicle::Upsampling::twice;
  } membrane;
  struct Mesh {
    int latitudes = 32;
    vesicle::FilterOrder filter = vesicle::FilterOrder::velocity_first;
    vesicle::SlipReference slip = vesicle::SlipReference::dealiased;
    int normal_degrees = 0;       ///< degrees kept in the velocity that shapes; 0: two thirds
    int tangential_degrees = 15;  ///< degrees kept in the velocity along the membrane
    Redistribute redistribute = Redistribute::when_needed;
    double max_aspect_ratio = vesicle::RedistributionLimits{}.aspect_ratio;
    double max_spectrum_tail = vesicle::RedistributionLimits{}.spectrum_tail;
  } mesh;
  struct Gravity {
    std::array<double, 3> acceleration{0.0, 0.0, 0.0};
  } gravity;
  struct Repulsion {
    double range = 0.0;       ///< 0 switches it off
    double strength = 100.0;  ///< pressure between two membranes in contact
    bool walls = true;        ///< whether walls repel too
  } repulsion;
  struct Time {
    double step = 1.0 / 48.0;
    double end = 8.0;
    MarkerMotion markers = MarkerMotion::shape_following;
    double relative_tolerance = 0.0;  ///< of markers = arkode
    double absolute_tolerance = 1e-6;
    FluidVelocity fluid_velocity = FluidVelocity::frozen;
    double relaxation = 0.25;          ///< a of markers = strain_relaxation
    double implicit_tolerance = 1e-5;  ///< of markers = implicit: largest change that ends the iteration, in radii
    int implicit_iterations = 100;     ///< and the most evaluations of the coupled problem in a step
    bool adaptive = false;             ///< steps are chosen by their errors; `step` is the first
    double tolerance = 2e-5;  ///< position error per step, root mean square over the markers, in effective radii
    double smallest_step = 1e-5;
    double largest_step = 0.1;
  } time;
  struct Limits {
    double local_area_error = 0.5;  ///< the simulation stops beyond it
    double velocity_noise =
        0.5;  ///< and beyond this share of a membrane's velocity that changes from step to step and back
    double area_error = 1e-3;    ///< relative change of an area that an adaptive step may make
    double volume_error = 1e-3;  ///< and of a volume
  } limits;
  std::vector<VesicleParameters> vesicles;

  // What holds for vesicle number i: its own value, or that for all.
  double capillary_number(std::size_t i) const;
  double sigma0(std::size_t i) const;
  double spontaneous_curvature(std::size_t i) const;
  int latitudes(std::size_t i) const;
  double viscosity_ratio(std::size_t i) const;  ///< lambda = mu_i/mu_o

  /// Largest grid spacing: what the grid resolves.
  double spacing() const;
  /// Smallest grid spacing: a delta function of that width answers most to forces, and so decides what is stable.
  double finest_spacing() const;
  /// g = dt sigma0/(4 mu h), the number that decides whether the explicit tension is stable (below 7 to 8), of the stiffest
  /// vesicle and the finest spacing.
  double tension_number() const;
  /// The largest g for which time.markers is stable, cautiously: 7, or 2 with the correction of the thickness, half of it for ab2,
  /// (2 - a)/a times it with strain relaxation, and infinity with shape_following and implicit.
  double stable_tension_number() const;
  /// Least and greatest viscosity, the 1 of the fluid outside included.
  struct ViscosityRange {
    double least = 1.0, greatest = 1.0;
    double contrast() const { return greatest / least; }
  };
  ViscosityRange viscosity_range() const;
  /// Whether the viscosity is another one inside some vesicle. If not, there is no field of it and no indicator.
  bool has_viscosity_contrast() const;
  /// Whether meshes follow the shapes and not the material.
  bool follows_shape() const;
  /// Steps of equal length from 0 to time.end, the last one at or just beyond it.
  long steps() const;
};

/// The domain as a grid.
VESIFLOW_COUPLING_EXPORT fluid::Grid grid_of(const SimulationParameters& parameters);
/// The fluid's own parameters, with viscosity 1: a contrast needs the membranes.
VESIFLOW_COUPLING_EXPORT fluid::FluidParameters fluid_parameters_of(const SimulationParameters& parameters);

struct Flow;

/// Checks all of it: the range of each parameter (coupling/parameter_table.h), then what no single one can be blamed for, such as vesicles
/// inside the box, a usable time step, and that they are apart. Simulation does so itself.
/// \throws ParameterError of all mistakes
VESIFLOW_COUPLING_EXPORT void check(const SimulationParameters& parameters, const Flow& flow);

}  // namespace vesiflow::coupling
