// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Public functions that take fields check, once in a call, that these are on the grid they must be on: loops do not look at extents.
#pragma once

#include "fluid/field.h"

namespace vesiflow::fluid {

// Throws std::invalid_argument with function, argument, the grid found and the one wanted, unless these are the same.
void check_grid(const char* function, const char* argument, const Grid& found, const Grid& wanted);

template <class CentringTag>
void check_grid(const char* function, const char* argument, const Field<CentringTag>& field, const Grid& wanted) {
  check_grid(function, argument, field.grid(), wanted);
}

// All three components.
inline void check_grid(const char* function, const char* argument, const FaceVector& u, const Grid& wanted) {
  check_grid(function, argument, u.x, wanted);
  check_grid(function, argument, u.y, wanted);
  check_grid(function, argument, u.z, wanted);
}

}  // namespace vesiflow::fluid
