// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/coefficients.h"
#include "vesicle/mesh_energy.h"
#include "vesicle/spherical_harmonics.h"
#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Velocity W of a mesh that follows the shape of a membrane and not its material. With U the fluid velocity at the
/// membrane, V + Omega x r the rigid motion of the shape (vesicle/rigid_motion.h) and P = I - n n^T,
///   W = (n.U) n + P (V + Omega x r + lambda d).
/// In tank-treading the mesh then stands still. d leads along the membrane down the mesh energy of
/// vesicle/mesh_energy.h: without it a vesicle that changes its shape presses markers together, and waves that are
/// short for the fluid's grid and long for the mesh grow.
class MeshMotion {
 public:
  /// \param harmonics of the degrees that are kept, which must outlive this
  /// \param radius of the sphere of the membrane's area
  MeshMotion(const vesicle::SphericalHarmonics& harmonics, double radius);

  struct Velocities {
    vesicle::VectorField membrane;  ///< U with the degrees that are kept, shape (markers, 3)
    vesicle::VectorField mesh;      ///< W, the same
    double largest_speed = 0.0;     ///< max |U - V|
  };

  /// Those of a step of length dt, of the interpolated velocity, shape (markers, 3).
  const Velocities& find(double dt, const vesicle::Surface& surface, const vesicle::VectorField& fluid_velocity);

 private:
  void relax(double rate, const vesicle::Surface& surface);

  const vesicle::SphericalHarmonics& harmonics_;
  double radius_;
  Velocities velocities_;
  vesicle::ScalarField normal_velocity_;
  vesicle::VectorField direction_;
  vesicle::MeshEnergyDescent descent_{{.lowest_degree = 2}};
  vesicle::Coefficients coefficients_;
};

}  // namespace vesiflow::coupling
