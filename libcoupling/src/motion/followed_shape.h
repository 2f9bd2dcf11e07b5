// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "motion/followed_state.h"
#include "motion/membrane_motion.h"
#include "motion/mesh_motion.h"
#include "motion/mirror_symmetry.h"
#include "motion/path_error.h"
#include "motion/shape_conservation.h"
#include "motion/slip.h"
#include "motion/strain_motion.h"
#include "vesicle/coefficients.h"
#include "vesicle/membrane.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {

/// A membrane whose mesh follows its shape and not its material, with the area strain s as a field on it: its state y
/// = (X, s), the rates (W, ds/dt) at which it changes (MeshMotion, StrainMotion), what it keeps (ShapeConservation),
/// and how a step begins and ends. How an increment is found is another's matter:
///   predict;  find_rates, there or at states that place() takes the membrane to;  finish.
class FollowedShape {
 public:
  using Fields = FollowedState::Fields;

  struct Parameters {
    int degrees = 0;      ///< that positions and strain keep
    double radius = 1.0;  ///< of the sphere of the membrane's area
    bool has_tension = true;
    bool ties_strain = true;  ///< s gets the mean that goes with the area where that is not kept
    ShapeConservation::Parameters conservation;
  };

  FollowedShape(const Parameters& parameters, const MirrorSymmetry& symmetry, const vesicle::Membrane& membrane);

  const vesicle::SphericalHarmonics& harmonics() const { return harmonics_; }
  const FollowedState& state() const { return state_; }

  /// Takes the membrane to y* = y^k + r d^k. Markers that have no history with this motion are new to it: what their
  /// shape has in degrees that are not kept would stand in space for good, so that goes, at the right volume and
  /// area.
  void predict(double dt, vesicle::Membrane& membrane);
  /// Takes it to any other state of the step.
  void place(const Fields& y, vesicle::Membrane& membrane);

  struct Rates {
    Fields fields;               ///< (W, ds/dt), without what would change what is kept
    Slip slip;                   ///< of the membrane over its mesh
    double largest_speed = 0.0;  ///< of the membrane, beside its translation
  };
  /// At the state that the membrane has been taken to, in the fluid's velocity there. Leaves the membrane's own.
  const Rates& find_rates(double dt, const vesicle::Surface& surface, MarkerVelocities& velocities);

  /// Takes the membrane to y^k + d, corrected to what is kept. `second_difference` is d - r d^k; the increment
  /// becomes the one that was made.
  void finish(double dt, Fields& increment, const Fields& second_difference, vesicle::Membrane& membrane);

  /// The membrane's own velocity, without a step.
  void find_membrane_velocity(double dt, const vesicle::Surface& surface, MarkerVelocities& velocities);

  const PathError& error() const { return error_; }
  long steps() const { return steps_; }
  MotionEntries entries() const { return {strain_motion_.entries(), conservation_.entries()}; }
  void restore(double last_dt, std::span<const double> strain, std::span<const double> increment, int smooth_steps,
               std::span<const double> bend);
  void restart();

 private:
  void start(vesicle::Membrane& membrane);
  void conserve(const vesicle::Surface& surface, Fields& increment);
  bool ties_strain_now() const { return ties_strain_ && !conservation_.keeps_area(); }

  bool ties_strain_;
  MirrorSymmetry symmetry_;
  vesicle::SphericalHarmonics harmonics_;
  FollowedState state_;
  MeshMotion mesh_motion_;
  StrainMotion strain_motion_;
  ShapeConservation conservation_;
  MeanStrain mean_strain_;
  PathError error_;
  long steps_ = 0;

  vesicle::ScalarField strain_;  // at the state that the membrane was last taken to
  Rates rates_;

  // Work space.
  Fields predicted_;
  vesicle::VectorField positions_, displacement_;
  vesicle::Coefficients coefficients_;
};

}  // namespace vesiflow::coupling
