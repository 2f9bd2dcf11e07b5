// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "fluid/export.h"
#include "fluid/field.h"

namespace vesiflow::fluid {

/// Takes a field from one grid to another: sets the points of `to` that lie in the box of `from` by trilinear
/// interpolation, exact for linear fields. Others are left as they are. Reads the ghosts of `from`, writes none.
VESIFLOW_FLUID_EXPORT void resample(const Field<Cell>& from, Field<Cell>& to);
/// The same for a vector.
/// \throws std::invalid_argument if its components are on different grids.
VESIFLOW_FLUID_EXPORT void resample(const FaceVector& from, FaceVector& to);

}  // namespace vesiflow::fluid
