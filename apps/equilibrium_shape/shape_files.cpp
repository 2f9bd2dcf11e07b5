#include "shape_files.h"

#include <fmt/format.h>

#include <fstream>
#include <numbers>

namespace equilibrium {
namespace {

using std::numbers::pi;
using vesiflow::vesicle::Coefficients;

std::string surface_coefficients(const Equilibrium& shape, const Coefficients& coefficients) {
  std::string text = fmt::format(
      "# Equilibrium shape, {} branch, reduced volume {:.17g}, V = 4 pi / 3, (1/2) int H^2 dA = {:.17g}\n"
      "# Spherical-harmonic coefficients of the positions, orders m >= 0: f_n^m multiplies P_n^m(cos theta) e^(i m "
      "phi),\n"
      "# fully normalised over the sphere, P_n^m > 0 next to the north pole, f_n^-m = (-1)^m conj(f_n^m)\n"
      "# degrees {}\n"
      "# n m re_x im_x re_y im_y re_z im_z\n",
      name_of(shape.branch), shape.reduced_volume, shape.energy, coefficients.degrees());
  for (int n = 0; n < coefficients.degrees(); ++n)
    for (int m = 0; m <= n; ++m) {
      text += fmt::format("{} {}", n, m);
      for (int field = 0; field < 3; ++field)
        text += fmt::format(" {:.17g} {:.17g}", coefficients(field, n, m).real(), coefficients(field, n, m).imag());
      text += '\n';
    }
  return text;
}

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

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw FileError(fmt::format("--output {}: cannot be made: {}", folder.string(), error.message()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw FileError(fmt::format("{}: cannot be written there", file.string()));
}

void write_shape(const std::filesystem::path& folder, const Equilibrium& shape, const ConstrainedEnergy& energy) {
  const std::string stem = fmt::format("{}_{}", name_of(shape.branch), shape.reduced_volume);
  write_text(folder / (stem + "_coefficients.txt"),
             surface_coefficients(shape, energy.surface().position_coefficients()));
  write_text(folder / (stem + "_meridian.csv"), meridian_table(energy));
}

}  // namespace equilibrium
