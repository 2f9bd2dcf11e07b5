// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/export.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Velocity V + Omega x (x - centre).
struct RigidMotion {
  Vector3 centre = Vector3::Zero();            ///< point about which the body turns
  Vector3 velocity = Vector3::Zero();          ///< V
  Vector3 angular_velocity = Vector3::Zero();  ///< Omega
};

/// The rigid motion that best explains how a surface moves as a shape, that is along its normal:
///
///     min over V, Omega of  int (U.n - (V + Omega x r).n)^2 dA + eps (|V|^2 + |Omega|^2 R^2) A,   eps = 1e-6,
///
/// r from the centroid of the area, R^2 its mean square. What does not move the shape (turning a body of revolution
/// about its axis, a sphere about any) is left at zero by the second term, which damps all else by eps over its share
/// of normal motion. It vanishes in tank-treading and follows the body in tumbling.
/// \param normal_velocity U.n, shape (markers).
/// \throws std::invalid_argument for a wrong size.
/// \throws std::domain_error if it is not finite.
VESIFLOW_VESICLE_EXPORT RigidMotion rigid_motion_of_shape(const Surface& surface, const ScalarField& normal_velocity);

}  // namespace vesiflow::vesicle
