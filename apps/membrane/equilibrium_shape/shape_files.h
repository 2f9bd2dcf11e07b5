// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "constrained_energy.h"
#include "equilibrium.h"

namespace equilibrium {

/// FOLDER/BRANCH_V_coefficients.txt: position coefficients in the convention of vesicle::SphericalHarmonics, one line
/// `n m re_x im_x re_y im_y re_z im_z` per degree and order, and FOLDER/BRANCH_V_meridian.csv: theta, arclength, rho, z
/// and tangent angle from pole to pole.
/// @throws FileError of program.h
void write_shape(const std::filesystem::path& folder, const Equilibrium& shape, const ConstrainedEnergy& energy);

}  // namespace equilibrium
