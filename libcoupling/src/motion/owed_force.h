// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "motion/bdf2.h"
#include "motion/membrane_response.h"
#include "motion/surrounding_fluid.h"
#include "vesicle/coefficients.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Force per area that past corrections of a motion owe to a fluid with inertia.
///
/// The implicit terms of a step change the increment of a membrane as if the velocity e^{k+1} that their forces make
/// had been in the fluid, which has not heard of it. What its terms at old times then lack is, in the next step,
///   Re/dt [(1 + r) e^k - r^2/(1 + r) e^{k-1}]              of the time derivative, and
///   mu_e e^k, or mu_e [(1 + r) e^k - r e^{k-1}] extrapolated, of the explicit part of the viscosity (per -Lap),
/// each e being that of the forces of its step, by MembraneResponse. Of the first a membrane that is curved as
/// strongly as its viscous layer is thick owes less, of the second a share (motion/constants.h). Without this force
/// the implicit terms meet a fluid that does not remember, and the recurrence grows by up to a half in each step.
class OwedForce {
 public:
  /// \param harmonics of the degrees that are kept, which must outlive this
  OwedForce(const vesicle::SphericalHarmonics& harmonics, int fields, const SurroundingFluid& fluid);

  /// Takes the forces that the correction of a step stands for: force per area (fields 0 to 2) and tension (field 3).
  void add(const vesicle::Coefficients& forces);

  /// Finds what is owed in the coming step, on the surface that it begins with.
  void find(double dt, const Bdf2& scheme, const MembraneResponse& response, const vesicle::Surface& surface);
  /// Shape (markers, 3); null if nothing is owed.
  const vesicle::VectorField* force() const { return owes_ ? &force_ : nullptr; }

  /// The history: how many of the last two steps have left forces, and these, the last step's first.
  int steps() const { return steps_; }
  std::span<const double> last() const;
  std::span<const double> older() const;
  void restore(int steps, std::span<const double> last, std::span<const double> older);
  void restart();

 private:
  /// Weights of the forces of the last step and of the one before.
  struct Weights {
    double last = 0.0, older = 0.0;
  };
  Weights of_time_derivative(double dt, const Bdf2& scheme, const vesicle::Surface& surface) const;
  Weights of_viscosity(const Bdf2& scheme) const;

  const vesicle::SphericalHarmonics& harmonics_;
  SurroundingFluid fluid_;
  vesicle::Coefficients last_, older_, owed_;
  int steps_ = 0;
  Eigen::ArrayXXd values_;
  vesicle::ScalarField tension_;
  vesicle::VectorField force_, of_tension_;
  bool owes_ = false;
};

}  // namespace vesiflow::coupling
