// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

/// \file
/// Second-order difference operators of the staggered grid.
///
/// Face results are set on the unknowns (inner faces, and on periodic axes all but the last, which is the first again);
/// faces on walls and mirrors and ghosts are left as they are. On a grid with mirrors all results are those on the
/// whole box. All loops are parallel, and give the same bits for every number of threads. Fields on different grids
/// raise std::invalid_argument.
#pragma once

#include "fluid/export.h"
#include "fluid/field.h"

namespace vesiflow::fluid {

/// g = grad p: differences of neighbouring cells. With zero g on the walls, `<g, u> = -<p, div u>` for every u that
/// vanishes on the walls (sums over unknowns): gradient and divergence are adjoint up to the sign. Reads the ghosts of
/// p across periodic axes (see extend_to_ghosts).
VESIFLOW_FLUID_EXPORT void gradient(const Field<Cell>& p, FaceVector& g);

/// d = div u at cell centres, from the six faces of each cell (those on walls included, see
/// WallVelocity::set_normal_faces). No ghosts are read or set.
VESIFLOW_FLUID_EXPORT void divergence(const FaceVector& u, Field<Cell>& d);

/// max |div u - source| over the cells, source being zero where it is null; infinite if u is not finite.
VESIFLOW_FLUID_EXPORT double max_divergence(const FaceVector& u, const Field<Cell>* source = nullptr);

/// n = N(u) = 1/2 (u.grad)u + 1/2 div(u u), for one component c at its faces (paper, Section 3.3, Step 3):
///
///     N_c = sum over axes d of [ubar_{d+} c_{d+} - ubar_{d-} c_{d-}] / (2 h_d),
///
/// where c_{d+-} are the neighbours along d and ubar_{d+-} the velocity along d, averaged to the points midway
/// to them. With zero walls `<u, N(u)> = 0` to round-off for every discretely divergence-free *or not* u: it
/// does no work. Reads the tangential ghosts of u next to the walls or mirrors (see WallVelocity::fill_ghosts).
VESIFLOW_FLUID_EXPORT void convection(const FaceVector& u, FaceVector& n);

}  // namespace vesiflow::fluid
