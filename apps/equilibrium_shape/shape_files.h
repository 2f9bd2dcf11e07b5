#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "constrained_energy.h"
#include "equilibrium.h"

namespace equilibrium {

/// A file of results could not be written. The message names it.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws FileError
void make_folder(const std::filesystem::path& folder);
void write_text(const std::filesystem::path& file, const std::string& text);

/// FOLDER/BRANCH_V_coefficients.txt: position coefficients in the convention of vesicle::SphericalHarmonics, one line
/// `n m re_x im_x re_y im_y re_z im_z` per degree and order, and FOLDER/BRANCH_V_meridian.csv: theta, arclength, rho, z
/// and tangent angle from pole to pole.
/// @throws FileError
void write_shape(const std::filesystem::path& folder, const Equilibrium& shape, const ConstrainedEnergy& energy);

}  // namespace equilibrium
