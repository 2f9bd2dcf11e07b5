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
#include "motion/stiffness.h"
#include "motion/wave_damping.h"

namespace vesiflow::coupling {

/// time.markers = "implicit": the equations of ShapeFollowing with forces and velocities at the new state, in
/// increments d
///   a0 d = a1 d^k + dt rates(y^k + d),   rates = (W, ds/dt) - damping y,
/// solved as the fixed point of a map that the implicit terms of ShapeFollowing make a contraction, or nearly so:
///   G(d) = d + (a0 + Z_n + dt (damping + w.grad))^{-1} [a1 d^k - a0 d + dt rates(y^k + d)].
/// The first evaluation, at d = r d^k, is a step of ShapeFollowing. At the fixed point Z does not matter, the fluid
/// has felt the forces of the new state and nothing is owed to it. The rates of the fluid are found outside
/// (ImplicitStep):
///   predict;  then forces, fluid and advance, which evaluates G, and try_increment, as often as needed;  accept.
/// The unknowns are coefficients of spherical harmonics whose mean square over the sphere is 1 (but for the order m >
/// 0: 1/2), positions in radii R of the membrane, strains times 1 + dt sigma0/4: a strain moves the membrane by its
/// own length until it has relaxed, and the fluid by sigma0/4 of it in unit time.
class ImplicitMotion final : public MembraneMotion {
 public:
  ImplicitMotion(const FollowingParameters& parameters, const MirrorSymmetry& symmetry,
                 const vesicle::Membrane& membrane);

  bool predict(double dt, vesicle::Membrane& membrane) override;
  /// Evaluates G at the increment under trial, for the membrane and its fluid there.
  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override;
  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override;

  std::size_t unknowns() const { return static_cast<std::size_t>(trial_.size()); }
  /// The increment under trial, after predict() that of the prediction, and G of it after advance().
  void get_trial(std::span<double> increment) const;
  void get_improved(std::span<double> increment) const;
  /// Brings the membrane to y^k + d.
  void try_increment(std::span<const double> increment, vesicle::Membrane& membrane);
  /// Ends the step with it.
  void accept(double dt, std::span<const double> increment, vesicle::Membrane& membrane);

  std::optional<double> position_error() const override { return shape_.error().value(); }
  MotionEntries entries() const override { return shape_.entries(); }
  MarkerStatistics statistics() const override { return {shape_.steps(), 0, evaluations_}; }

  /// Of the form of ShapeFollowing's, with nothing owed.
  std::span<const double> history() const override;
  void restore_history(double dt, std::span<const double> history) override;
  void restart() override { shape_.restart(); }

 private:
  using Vector = IncrementSolver::Vector;

  void find_scales(double dt);

  FollowingParameters parameters_;
  FollowedShape shape_;
  MembraneResponse response_;
  // The implicit terms, those of the predicted state through all of a step, so that the equations are the same ones.
  Stiffness stiffness_;
  WaveDamping damping_;
  ImplicitDiagonal diagonal_;
  bool has_implicit_terms_ = false;
  IncrementSolver solver_;

  // As coefficients of spherical harmonics: y^k, d^k, the increment under trial and G of it; and what an unknown is
  // over its coefficient.
  Vector state_, last_increment_, trial_, improved_, scales_;
  long evaluations_ = 0;

  // Work space.
  FollowedShape::Fields fields_, increment_;
  vesicle::Coefficients coefficients_, trial_state_;
  Vector right_side_;
  std::vector<double> nothing_owed_;
  mutable std::vector<double> history_;
};

}  // namespace vesiflow::coupling
