// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/membrane.h"

namespace vesiflow::coupling {

/// What of a membrane's state decides how stiff it is.
struct MembraneCondition {
  double largest_tension = 0.0;     ///< at least 0
  double compression = 1.0;         ///< of the mesh, see greatest_compression()
  double curvature_variance = 0.0;  ///< of 2 H over the membrane; of no interest without tension

  /// At its last geometry and forces. \param radius of the sphere of its area
  static MembraneCondition of(const vesicle::Membrane& membrane, double radius);
};

/// The greatest ratio of a length on the sphere of that radius to that of its image on the membrane, along the
/// coordinates; at least 1.
double greatest_compression(const vesicle::Surface& surface, double radius);

}  // namespace vesiflow::coupling
