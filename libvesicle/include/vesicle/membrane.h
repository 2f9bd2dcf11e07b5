// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "vesicle/area.h"
#include "vesicle/bending.h"
#include "vesicle/conservation.h"
#include "vesicle/export.h"
#include "vesicle/integral_tension.h"
#include "vesicle/mesh_control.h"
#include "vesicle/redistribution.h"
#include "vesicle/surface.h"
#include "vesicle/tension.h"
#include "vesicle/types.h"
#include "vesicle/volume.h"

namespace vesiflow::vesicle {

/// How the enclosed volume is kept.
enum class VolumeControl {
  none,       ///< it is not kept
  penalty,    ///< the force of Eq. (22), stiffness c_v
  projection  ///< the marker velocity is corrected, see ConservationProjection
};

/// How the total area is kept, beside the tension that keeps local areas.
enum class AreaControl {
  none,       ///< only the tension keeps it
  penalty,    ///< the force of add_area_penalty, stiffness c_a
  projection  ///< the marker velocity is corrected, see ConservationProjection
};

/// All that decides what a membrane does.
struct MembraneParameters {
  double capillary_number = 2.5;                       ///< Ca > 0 of Eq. (21); infinity switches bending off
  double spontaneous_curvature = 0;                    ///< H0 of bending_energy
  double sigma0 = 600;                                 ///< tension stiffness >= 0 of Eq. (31); 0 switches tension off
  TensionLaw tension_law = TensionLaw::logarithmic;    ///< how tension follows from strain
  TensionForm tension_form = TensionForm::divergence;  ///< how its force is discretised

  /// a in (0, 1]: the tension is that of the strain s of s^{k+1} = s^k + a (ln J - s^k), a low-pass filter in time; 1:
  /// of ln J.
  double strain_relaxation = 1;
  IntegralTensionParameters integral_tension = {};   ///< rate 0: none
  LaplacianOptions laplacian = {};                   ///< of the bending force
  VolumeControl volume = VolumeControl::projection;  ///< how the volume is kept
  double volume_stiffness = 0;                       ///< c_v >= 0 of Eq. (22), read for VolumeControl::penalty only
  AreaControl area = AreaControl::none;              ///< how the total area is kept
  double area_stiffness = 0;                         ///< c_a >= 0, read for AreaControl::penalty only
  FilterOrder filter = FilterOrder::velocity_first;  ///< how marker velocities are filtered, see MeshFilter
  int normal_degrees = 0;                            ///< degrees kept in the normal velocity; 0: the 2N/3 rule
  int tangential_degrees = 15;                       ///< degrees kept in the tangential velocity
  SlipReference slip = SlipReference::dealiased;     ///< for the update of target areas, which is done for sigma0 > 0
};

/// Everything a membrane must remember between steps; restoring it repeats an uninterrupted run bit for bit.
struct MembraneState {
  VectorField positions;         ///< (markers, 3)
  ScalarField target_areas;      ///< dA0_ij now, (markers)
  ScalarField initial_areas;     ///< dA_ij at t = 0, (markers); their sum is the initial area
  double initial_volume = 0;     ///< V at t = 0
  ScalarField lagged_strain;     ///< s, (markers); empty if strain_relaxation = 1
  ScalarField integral_tension;  ///< Z, (markers); empty if there is none
};

/// How often the parts that parameters can switch off were entered, since construction.
struct MembraneEntries {
  std::int64_t tension = 0,  ///< entries of the force of the tension
      target_areas = 0,      ///< entries of the update of the target areas
      conservation = 0;      ///< entries of the projections on volume and area
};

/// One vesicle: markers, forces per unit area, and mesh control. A step of a simulation reads
///
///     update_geometry(); compute_force();   (spread, solve the fluid, interpolate U)
///     filter_velocity(U, dt, U~); advance(X + dt U~, U, U~, dt);
///
/// Nothing allocates once each of these has been called. One thread at a time per membrane.
class VESIFLOW_VESICLE_EXPORT Membrane {
 public:
  /// Takes the initial positions, shape (2 latitudes^2, 3), as the unstretched state, and updates the
  /// geometry.
  /// \throws std::invalid_argument for bad parameters (named, with value and range) or a wrong size.
  /// \throws std::domain_error as Surface::update, or if the volume is not positive (inward orientation).
  Membrane(const VectorField& initial_positions, int latitudes, const MembraneParameters& parameters);

  /// Computes the geometry at the current positions.
  /// \throws std::domain_error as Surface::update().
  void update_geometry();

  /// Sum of the forces that are switched on, per unit area, shape (markers, 3). Uses the geometry of the last
  /// update_geometry().
  const VectorField& compute_force();

  /// Mesh filter of the interpolated velocity, then the volume and area projections if chosen. The two fields must be
  /// distinct.
  /// \param velocity interpolated U, shape (markers, 3).
  /// \param filtered U~, shape (markers, 3).
  /// \throws std::invalid_argument as MeshFilter::apply() and, with a projection,
  /// ConservationProjection::correct_velocity().
  /// \throws std::domain_error as these.
  void filter_velocity(const VectorField& velocity, double dt, VectorField& filtered);

  /// Changes a displacement of the markers, shape (markers, 3), so that it ends at the volume and area that are kept by
  /// projection, to a relative 1e-13: beyond what filter_velocity() does for the velocity. Nothing without projections.
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error as ConservationProjection::correct_displacement().
  void correct_displacement(VectorField& displacement);

  /// Ends a step: updates the target areas by Eqs. (33) and (32) with the geometry of the old positions (skipped for
  /// sigma0 = 0), then lagged strain and integral tension if there are any, then takes the new positions. The geometry
  /// stays the old one until update_geometry().
  /// \param new_positions shape (markers, 3).
  /// \param velocity interpolated U, shape (markers, 3).
  /// \param filtered the velocity U~ that moved the markers, shape (markers, 3), as averaged over the step by the
  /// integrator.
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error if the new positions are not finite or as TargetAreaUpdate::apply(). The membrane is
  /// then as it was.
  void advance(const VectorField& new_positions, const VectorField& velocity, const VectorField& filtered, double dt);

  /// Takes positions and the log strain ln(dA/dA0) there, shape (markers), for a mesh that does not move with the
  /// material, and updates the geometry: the target areas become dA e^{-strain}. As markers are no labels then, the
  /// initial areas are these too, scaled to their old total. If it throws, the membrane's state is as it was.
  /// \throws std::invalid_argument for a wrong size.
  /// \throws std::domain_error as Surface::update(), and if a strain is not finite.
  void move_to(const VectorField& positions, const ScalarField& strain);

  /// Moves the markers along the membrane to a better mesh, if there is one, with the membrane's own fields: the
  /// strains ln(dA/dA0) and ln(dA/dA(0)) stay with the material, so tension, max_local_area_error and
  /// max_label_area_error mean what they did before; both target and initial areas keep their totals. A "label" is then
  /// a material point and no longer a marker number. Updates the geometry before and after. `redistribution` must have
  /// the same number of latitudes.
  RedistributionReport redistribute(MeshRedistribution& redistribution);

  /// From now on advance() scales the target areas to the sum that they have now, in the place of the initial area: for
  /// a membrane whose strain has a mean from elsewhere, which would go in one step otherwise. restore() leaves that sum
  /// alone.
  void keep_target_area();

  const MembraneParameters& parameters() const { return parameters_; }  ///< the parameters that were given
  const Surface& surface() const { return surface_; }                   ///< the surface at the last geometry
  const VectorField& positions() const { return positions_; }           ///< marker positions, shape (markers, 3)

  /// Force per unit area of the last compute_force(), shape (markers, 3); zero before the first call.
  const VectorField& force() const { return force_; }
  /// Tension of the last compute_force(), shape (markers); zero if sigma0 = 0 and before the first call.
  const ScalarField& tension() const { return tension_; }

  const ScalarField& target_areas() const { return target_areas_; }    ///< dA0_ij, shape (markers)
  const ScalarField& initial_areas() const { return initial_areas_; }  ///< dA_ij at t = 0, shape (markers)
  double initial_area() const { return initial_area_; }                ///< their sum
  double initial_volume() const { return initial_volume_; }            ///< V at t = 0

  /// Z of the integral tension; empty if there is none.
  const ScalarField& integral_tension() const { return integral_tension_; }

  /// bending_energy / Ca + E_sigma + penalty energies of the parts that are switched on, at the last geometry.
  double energy() const;
  /// The same without bending. The force is minus its derivative, at fixed Z, unless the strain is relaxed.
  double elastic_energy() const;

  const MembraneEntries& entries() const { return entries_; }  ///< see MembraneEntries

  MembraneState state() const;  ///< what restore() takes

  /// Replaces the state and updates the geometry.
  /// \throws std::invalid_argument if an array has the wrong size or an area or the volume is not positive and finite.
  /// \throws std::domain_error as Surface::update. The membrane's own state is then as it was, and needs
  /// update_geometry().
  void restore(const MembraneState& state);

 private:
  // Detail of the geometry that every step needs.
  GeometryDetail detail() const;
  void conserve();
  bool relaxes_strain() const { return tension_force_ && parameters_.strain_relaxation < 1; }
  void evaluate_tension();

  MembraneParameters parameters_;
  Surface surface_;
  std::optional<BendingForce> bending_;
  std::optional<TensionForce> tension_force_;
  std::optional<IntegralTension> integral_;
  std::optional<ConservationProjection> conservation_;
  MeshFilter filter_;
  TargetAreaUpdate target_area_update_;

  VectorField positions_, force_;
  ScalarField tension_, target_areas_, initial_areas_;
  ScalarField strain_, lagged_strain_, integral_tension_;  // empty where not needed
  double initial_area_ = 0;
  std::optional<double> kept_target_area_;  // see keep_target_area()
  double initial_volume_ = 0;
  MembraneEntries entries_;
};

}  // namespace vesiflow::vesicle
