// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Fields from one grid to another.
#pragma once

#include "fluid/export.h"
#include "fluid/field.h"

namespace vesiflow::fluid {

// Sets the points of `to` that lie in the box of `from` by trilinear interpolation, exact for linear fields. Others are left as
// they are. Reads the ghosts of `from`, writes none.
// Throws std::invalid_argument if the components of a vector are on different grids.
VESIFLOW_FLUID_EXPORT void resample(const Field<Cell>& from, Field<Cell>& to);
VESIFLOW_FLUID_EXPORT void resample(const FaceVector& from, FaceVector& to);

}  // namespace vesiflow::fluid
