// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/surface.h"

namespace vesiflow::coupling {

/// What a membrane's velocity has that a smooth motion has not: the part that changes from one step to the next and back,
///   noise = max |U_n - 2 U_(n-1) + U_(n-2)| / 4   over the markers.
/// A part of the velocity that changes its sign in every step counts with its full amplitude, one that is smooth in time with (dt^2/4) |U''|.
/// Instabilities of explicit terms change sign from step to step where they are at their limit of stability.
class VelocityNoise {
 public:
  /// After a step, U of shape (markers, 3).
  void update(const vesicle::VectorField& velocity);
  /// Forgets the velocities before: they belong to other markers.
  void restart() { known_ = 0; }

  /// 0 until three steps are known.
  double value() const { return value_; }
  double greatest_speed() const { return speed_; }
  /// Where the noise is greatest.
  Eigen::Index marker() const { return marker_; }

 private:
  vesicle::VectorField last_, before_;
  int known_ = 0;
  double value_ = 0.0, speed_ = 0.0;
  Eigen::Index marker_ = 0;
};

}  // namespace vesiflow::coupling
