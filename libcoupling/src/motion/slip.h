// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Slip w = U - W of a membrane over its mesh in the coordinates of the mesh: w.grad f = theta df/dtheta + phi
/// df/dphi. Shape (markers) each.
struct Slip {
  vesicle::ScalarField theta, phi;

  /// Of the velocities of membrane and mesh, shape (markers, 3) each.
  void find(const vesicle::Surface& surface, const vesicle::VectorField& membrane, const vesicle::VectorField& mesh) {
    theta = ((membrane - mesh) * surface.geometry().dual_theta()).rowwise().sum();
    phi = ((membrane - mesh) * surface.geometry().dual_phi()).rowwise().sum();
  }
};

}  // namespace vesiflow::coupling
