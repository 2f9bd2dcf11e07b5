// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vesicle/surface.h"
#include "vesicle/types.h"

namespace vesiflow::coupling {

/// Rate of the area strain s = ln(dA/dA0) on a mesh that moves with W while the membrane moves with U: ds/dt = div U
/// - (U - W).grad s.
class StrainMotion {
 public:
  explicit StrainMotion(Eigen::Index markers);

  /// Shape (markers), of U and W (markers, 3) and s (markers).
  const vesicle::ScalarField& find_rate(const vesicle::Surface& surface, const vesicle::VectorField& membrane,
                                        const vesicle::VectorField& mesh, const vesicle::ScalarField& strain);

  /// The constant that the last rate lacks for int exp(-s) dA, the area of the unstrained membrane, not to change
  /// where the mesh moves with `velocity`, shape (markers, 3): what that does to the volume, and what of the fluid's
  /// flux does not move the membrane, are not in div U.
  double missing_rate(const vesicle::Surface& surface, const vesicle::VectorField& velocity,
                      const vesicle::ScalarField& strain);

  /// How often a rate was found.
  std::int64_t entries() const { return entries_; }

 private:
  vesicle::VectorField gradient_;
  vesicle::ScalarField divergence_, rate_;
  std::int64_t entries_ = 0;
};

}  // namespace vesiflow::coupling
