// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vesiflow::coupling {

/// What the mean of both sides of a field w is, over its jump, where the jump across a sphere of radius R is that of a
/// rigid motion and stresses go on across it: a w - Lap w + grad p = 0, div w = 0 on both sides.
struct RigidResponse {
  double translation;  ///< of [w] a constant vector
  double rotation;     ///< of [w] = e x x
};

/// Both are -1/2 for a = 0: the inside moves by -[w] and the outside rests.
/// \param a_r2 a R^2, >= 0
RigidResponse rigid_response(double a_r2);

}  // namespace vesiflow::coupling
