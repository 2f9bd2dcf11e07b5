// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "motion/followed_shape.h"
#include "motion/following_parameters.h"
#include "motion/implicit_diagonal.h"
#include "motion/increment_solver.h"
#include "motion/membrane_motion.h"
#include "motion/membrane_response.h"
#include "motion/owed_force.h"
#include "motion/stiffness.h"
#include "motion/wave_damping.h"

namespace vesiflow::coupling {

/// time.markers = "shape_following": a mesh that follows the shape of the vesicle and not its material, with the area
/// strain s = ln(dA/dA0) as a field on it. With U the fluid velocity at the membrane, W that of the mesh (MeshMotion)
/// and w = U - W the slip,
///   dX/dt = W,   ds/dt = div U - w.grad s.
/// In tank-treading the mesh stands still and nothing at all changes: steady states do not depend on the time step.
///
/// A step is BDF2 in the increments d = y^{k+1} - y^k of y = (X, s), forces and velocities being taken at the
/// extrapolated state y* = y^k + r d^k, with a linearly implicit correction:
///   (a0 + Z_n + dt (D_n + w.grad)) d^{k+1} = (a1 + r (Z_n + dt (D_n + w.grad))) d^k + dt [(W, ds/dt)* - D_n y*],
/// Z_n being the stiffness of a mode of degree n (Stiffness) and D_n the damping of the highest ones (WaveDamping).
/// The terms of the correction meet d^{k+1} - r d^k only, so that a step is exact to second order for any Z. It is
/// limited by accuracy, not by sigma0: sigma0 may be so large that strains are negligible. A fluid with inertia, or
/// with a viscosity that is explicit in part, is told of the velocities that the corrections stand for by the forces
/// that its next steps are owed (OwedForce).
///
/// Area and volume are exact after each step, but for nearly spherical shapes (ShapeConservation, MeanStrain).
class ShapeFollowing final : public MembraneMotion {
 public:
  ShapeFollowing(const FollowingParameters& parameters, const MirrorSymmetry& symmetry,
                 const vesicle::Membrane& membrane);

  bool predict(double dt, vesicle::Membrane& membrane) override;
  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override;
  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override;
  const vesicle::VectorField* correcting_force() const override {
    return correcting_force_.rows() > 0 ? &correcting_force_ : nullptr;
  }
  const vesicle::VectorField* owed_force() const override { return owed_ ? owed_->force() : nullptr; }
  std::optional<double> position_error() const override { return shape_.error().value(); }

  MotionEntries entries() const override { return shape_.entries(); }
  MarkerStatistics statistics() const override { return {shape_.steps(), 0, shape_.steps()}; }

  std::span<const double> history() const override;
  void restore_history(double dt, std::span<const double> history) override;
  void restart() override;

 private:
  FollowingParameters parameters_;
  FollowedShape shape_;
  MembraneResponse response_;
  Stiffness stiffness_;
  WaveDamping damping_;
  ImplicitDiagonal diagonal_;
  IncrementSolver solver_;
  std::optional<OwedForce> owed_;  // of a fluid with inertia; another one remembers nothing

  // Work space: fields at the markers, and the same as coefficients of spherical harmonics.
  FollowedShape::Fields predicted_, increment_, second_difference_;
  vesicle::Coefficients predicted_coefficients_, last_coefficients_, coefficients_, forces_;
  IncrementSolver::Vector right_side_;
  void find_correcting_force(const vesicle::Surface& surface);
  Eigen::ArrayXXd force_values_;
  vesicle::ScalarField tension_;
  vesicle::VectorField correcting_force_, of_tension_;  // none unless the fluid is told at once
  mutable std::vector<double> history_;
};

}  // namespace vesiflow::coupling
