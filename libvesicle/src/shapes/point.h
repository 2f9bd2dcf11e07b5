// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vesicle/types.h"

namespace vesiflow::vesicle {

/// Row i of points of shape (n, 3).
inline Vector3 point(const VectorField& points, Eigen::Index i) {
  return points.row(i).matrix().transpose();
}

}  // namespace vesiflow::vesicle
