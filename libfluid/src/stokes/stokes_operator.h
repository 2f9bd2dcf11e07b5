// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The gradient and the divergence of the Stokes equations on arrays with ghosts, in any mix of walls and periodic axes.
#pragma once

#include "fluid/grid.h"
#include "fluid/view.h"
#include "operators/stencil.h"

namespace vesiflow::fluid {

// y += grad p on the unknowns of the velocity. Sets the ghosts of p.
void add_gradient(const Grid& grid, GhostedBlocks& p, Blocks y);

// d = -div u from all faces of the cells: those on walls and the last ones of periodic axes must have been set.
void negative_divergence(const Grid& grid, ConstBlocks u_points, View d);

}  // namespace vesiflow::fluid
