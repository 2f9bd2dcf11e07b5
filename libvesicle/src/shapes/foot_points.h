// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/coefficients.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// A surface X at points of the unit sphere, with its linearisation.
class FootPoints {
 public:
  /// surface: three fields.
  explicit FootPoints(const Coefficients& surface);

  /// One step of Gauss-Newton from X(y) towards the nearest point to each of `points`: the displacement along the
  /// sphere, and what of points - X(y) is across the surface there. All of shape (points, 3).
  void find(const VectorField& places, const VectorField& points, VectorField& displacement, VectorField& across) const;

 private:
  const Coefficients& surface_;
  Coefficients gradients_;  // Cartesian components of the three surface gradients, of one degree more
};

}  // namespace vesiflow::vesicle
