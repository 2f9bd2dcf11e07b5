// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// The velocity U of a membrane that has another viscosity inside, ratio times that outside.
///
/// In each phase w = mu u obeys the equations of viscosity 1, with the jump q = [w] = (1 - ratio) U across the membrane;
/// so one solve with constant coefficients gives w for a known U, and the mean of w on both sides gives U back:
///     U = 2 w_mean/(1 + ratio).
/// U is the fixed point of this map. Its slowest parts are known in closed form, and taken out: rigid motions, on which
/// the map has the eigenvalue (ratio - 1)/(ratio + 1) where there is no inertia and that of a sphere (RigidResponse)
/// where there is, so that their part of a change is divided by one less this, and the dilation, which no incompressible
/// fluid has: the net flux is removed. The map is affine while the forces stay, so what it did to the last few U tells
/// of the next: Anderson's acceleration (J. ACM 12, 1965; Walker & Ni, SIAM J. Numer. Anal. 49, 2011). Augmented
/// variables and scaled velocities for two viscosities: Li, Ito & Lai, Computers & Fluids 36 (2007).
/// docs/jump_conditions.md.
class InterfaceVelocity {
 public:
  InterfaceVelocity(double ratio, Eigen::Index markers);

  double ratio() const { return ratio_; }
  /// U (markers x 3), zero at first.
  const vesicle::VectorField& value() const { return velocity_; }
  /// U one step ago, (markers x 3), or (0 x 3) where there was none.
  vesicle::VectorField previous() const { return has_previous_ ? previous_ : vesicle::VectorField(0, 3); }
  /// Takes U (markers x 3) from elsewhere, and what previous() gives.
  void set(const vesicle::VectorField& velocity, const vesicle::VectorField& previous = vesicle::VectorField(0, 3));
  /// Begins a step, which is `ratio_of_steps` times as long as the last one: U is extrapolated.
  void begin_step(double ratio_of_steps);
  /// Forgets what the map did before: the forces are others.
  void begin_iteration() { passes_ = 0; }
  /// Of a fluid whose solver has the acceleration a w: a R^2, R the radius of a sphere of the same volume. Zero at first.
  void set_inertia(double a_r2);
  /// q (markers x 3).
  const vesicle::VectorField& jump();

  /// Takes the mean of w on both sides (markers x 3) that the last jump() has led to, and gets nearer to U. Returns how far
  /// the map was from giving U back, root mean square over that of U.
  double improve(const vesicle::Surface& surface, const vesicle::VectorField& mean);

  /// Takes out of U what it is known not to have: project(U).
  template <class Projection>
  void project(const Projection& project) {
    project(velocity_);
  }

  /// int x (q . n) dA, x from the centroid of the area: what the integral of w over a box is less than that of u.
  vesicle::Vector3 displaced(const vesicle::Surface& surface);

 private:
  void accelerate(const vesicle::ScalarField& weight);

  double ratio_;
  double more_translation_, more_rotation_;  // of a change, beside itself
  vesicle::VectorField velocity_, jump_, change_, previous_;
  bool has_previous_ = false;
  int passes_ = 0;  // since the iteration began
  double last_residual_ = 0.0;
  vesicle::VectorField last_velocity_, last_change_;
  struct Secant {
    vesicle::VectorField velocity, change;  // differences from one pass to the next; changes are orthogonal
  };
  std::array<Secant, 3> secants_;
};

}  // namespace vesiflow::coupling
