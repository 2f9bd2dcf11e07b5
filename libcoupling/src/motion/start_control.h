// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "motion/constants.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// Divides the first of equal steps into parts where shapes start far from rest.
///
/// A step knows the forces of one shape, so that no shape should become another one in it. What the velocity U of a
/// membrane would change of its shape in dt is, over its radius of curvature,
///   dt max |n.(U - V - Omega x r)| (kappa_1^2 + kappa_2^2)^(1/2),
/// V + Omega x r being the rigid motion of the shape, the curvatures those before the step. It is a number without
/// units. (What the markers have moved says less: the implicit terms hold them back.) A first step with a large one,
/// or which cannot be computed, is taken back and begun again in halves, quarters, ... of time.step. After some calm
/// parts they are twice as long, where they then fit into the step (BDF2 is stable while steps grow by less than 1 +
/// sqrt 2), so that all steps end when they would have ended. The start is over when the next part would
/// be a whole step.
class StartControl {
 public:
  /// Whether the step after so many is part of a start.
  bool watches(long steps) const { return steps == 0 || level_ > 0; }
  /// Parts that have been taken, 0 where the first step was whole.
  long parts() const { return parts_; }

  /// Length of the coming part of a step of length `step` that ends at `end`.
  double next(double time, double end, double step) const;
  /// Whether parts cannot be shorter: a thousandth of a step.
  bool is_shortest() const { return level_ == finest_level; }
  /// Halves the part that was taken back.
  void shorten();
  /// Whether a part that changed shapes so much is short enough, after so many steps. What is fast for long is no
  /// start.
  bool accepts(double change, long steps) const;
  /// The part is taken. Returns whether the step is complete.
  bool advance(double change, long steps);

  /// For a continued run, at the end of a step; empty where none was divided.
  std::vector<double> state() const;
  /// \throws std::invalid_argument for what no state() has given
  void restore(std::span<const double> state);

 private:
  static constexpr int finest_level = constants::finest_part_level;
  static constexpr std::int64_t whole_step = std::int64_t{1} << finest_level;

  int level_ = 0;              // parts are 2^-level of a step
  int calm_parts_ = 0;         // of this level, on end
  std::int64_t position_ = 0;  // in the step, in shortest parts
  long parts_ = 0;
};

/// (kappa_1^2 + kappa_2^2)^(1/2) at the markers.
vesicle::ScalarField total_curvature(const vesicle::Surface& surface);
/// max |n.(U - V - Omega x r)| times a curvature: how fast a surface whose markers have the velocity U changes its
/// shape.
double rate_of_shape(const vesicle::Surface& surface, const vesicle::VectorField& velocity,
                     const vesicle::ScalarField& curvature);

}  // namespace vesiflow::coupling
