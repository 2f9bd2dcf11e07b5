// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape_files.h"

#include <fmt/format.h>

#include <numbers>

#include "output_files.h"
#include "vesicle/surface_file.h"

namespace equilibrium {
namespace {

using std::numbers::pi;

std::string meridian_table(const ConstrainedEnergy& energy) {
  const Meridian& meridian = energy.meridian();
  const auto& grid = energy.surface().grid();
  const double ell = meridian.arclength_per_colatitude();
  std::string text = "theta,arclength,rho,z,tangent_angle\n";
  const auto line = [&](double theta, double rho, double z) {
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", theta, ell * theta, rho, z,
                        meridian.tangent_angle(theta));
  };
  line(0, 0, meridian.polar_semi_axis());
  for (int j = 0; j < grid.latitudes(); ++j) line(grid.colatitude()[j], meridian.rho()[j], meridian.z()[j]);
  line(pi, 0, -meridian.polar_semi_axis());
  return text;
}

}  // namespace

void write_shape(const std::filesystem::path& folder, const Equilibrium& shape, const ConstrainedEnergy& energy) {
  const std::string stem = fmt::format("{}_{}", name_of(shape.branch), shape.reduced_volume);
  vesiflow::vesicle::write_surface_coefficients(folder / (stem + "_coefficients.txt"),
                                                energy.surface().position_coefficients());
  write_text(folder / (stem + "_meridian.csv"), meridian_table(energy));
}

}  // namespace equilibrium
