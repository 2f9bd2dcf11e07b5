// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "fluid/field.h"
#include "transfer/grid_band.h"
#include "viscosity/inside_points.h"

namespace vesiflow::coupling {

/// The velocity u of a fluid with sharp membranes between two viscosities, whose solver has w = mu u less a mean flow
/// (InterfaceVelocity): u = w + mean outside, (w + mean)/ratio at the points of the grid that are inside a membrane.
class PhysicalVelocity {
 public:
  explicit PhysicalVelocity(const fluid::Grid& grid) : velocity_(grid) {}

  /// Begins with w + mean everywhere, ghosts included.
  void set(const fluid::FaceVector& scaled, const fluid::Vector3& mean_flow);

  /// Divides component number 0, 1 or 2 by the ratio inside a membrane. \param band of that component, at least as wide
  /// as a spacing
  void divide_inside(int component, const GridBand& band, double ratio);

  /// What has come of it.
  const fluid::FaceVector& value() const { return velocity_; }
  fluid::FaceVector take() && { return std::move(velocity_); }

 private:
  fluid::FaceVector velocity_;
  InsidePoints inside_;
};

}  // namespace vesiflow::coupling
