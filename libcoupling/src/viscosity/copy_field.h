// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "fluid/field.h"

namespace vesiflow::coupling {

/// Between fields of one grid, ghosts included.
inline void copy_field(const fluid::FaceVector& from, fluid::FaceVector& to) {
  std::copy_n(from.x.data(), from.x.size(), to.x.data());
  std::copy_n(from.y.data(), from.y.size(), to.y.data());
  std::copy_n(from.z.data(), from.z.size(), to.z.data());
}

}  // namespace vesiflow::coupling
