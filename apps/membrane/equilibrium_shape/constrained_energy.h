// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "meridian.h"
#include "vesicle/bending.h"
#include "vesicle/surface.h"

namespace equilibrium {

/// Bending energy (1/2) int H^2 dA, area and enclosed volume.
struct Functionals {
  double energy = 0, area = 0, volume = 0;
};

/// Their derivatives with respect to the unknowns of Meridian, each of shape (unknowns).
struct Gradients {
  Eigen::VectorXd energy, area, volume;
};

/// The problem that all methods solve: least bending energy of the shapes of a Meridian with given area and volume. Energy,
/// area, volume and the bending force are libvesicle's, on the full marker mesh; by the first variation
///   dE = -int f_b n . dX dA,  dA = int 2 H n . dX dA,  dV = int n . dX dA.
class ConstrainedEnergy {
 public:
  static constexpr int minimum_latitudes = 12;

  /// @throws std::invalid_argument unless latitudes >= minimum_latitudes.
  explicit ConstrainedEnergy(int latitudes);

  /// Targets V = 4 pi / 3 and the area that gives the reduced volume; 1 before the first call.
  /// @throws std::invalid_argument unless 0 < reduced_volume <= 1.
  void set_reduced_volume(double reduced_volume);

  int unknowns() const { return meridian_.unknowns(); }
  double target_area() const { return target_area_; }
  double target_volume() const { return target_volume_; }

  /// Takes the shape with these unknowns.
  /// @throws std::domain_error if its mesh is degenerate.
  void set(const Eigen::VectorXd& x);
  const Functionals& functionals() const { return functionals_; }
  /// (A - target, V - target), each relative to its target.
  Eigen::Vector2d constraint_errors() const;

  /// Gradients at the shape of the last set(). The area's and the volume's alone cost a tenth of all three.
  const Gradients& constraint_gradients();
  const Gradients& gradients();

  const Meridian& meridian() const { return meridian_; }
  const vesiflow::vesicle::Surface& surface() const { return surface_; }
  /// Normal bending force per unit area f_b at the markers, as of the last gradients().
  const vesiflow::vesicle::ScalarField& normal_force() const { return normal_force_; }
  /// How many times gradients() was called: the measure of work.
  int gradient_evaluations() const { return gradient_evaluations_; }

 private:
  Eigen::VectorXd first_variation(const vesiflow::vesicle::ScalarField& density) const;

  vesiflow::vesicle::Surface surface_;
  vesiflow::vesicle::BendingForce bending_;
  Meridian meridian_;
  double target_area_, target_volume_;
  vesiflow::vesicle::VectorField positions_, force_;
  vesiflow::vesicle::ScalarField normal_force_;
  Eigen::ArrayXXd rho_derivative_, z_derivative_;
  Functionals functionals_;
  Gradients gradients_;
  int gradient_evaluations_ = 0;
};

}  // namespace equilibrium
