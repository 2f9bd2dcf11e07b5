// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <fmt/format.h>

#include <numbers>

namespace equilibrium {
namespace {

constexpr double sphere_energy = 2 * std::numbers::pi;

nlohmann::json to_json(const Equilibrium& shape) {
  return {{"reduced_volume", shape.reduced_volume},
          {"converged", true},
          {"bending_energy", shape.energy},
          {"bending_energy_over_sphere", shape.energy / sphere_energy},
          {"tension", shape.tension},
          {"pressure", shape.pressure},
          {"polar_semi_axis", shape.polar_semi_axis},
          {"equatorial_radius", shape.equatorial_radius},
          {"half_arclength", shape.half_arclength},
          {"polar_mean_curvature", shape.polar_mean_curvature},
          {"equatorial_mean_curvature", shape.equatorial_mean_curvature},
          {"area_error", shape.area_error},
          {"volume_error", shape.volume_error},
          {"gradient_residual", shape.residual},
          {"euler_lagrange_residual", shape.euler_lagrange_residual},
          {"largest_bending_force", shape.largest_force},
          {"scaling_error", shape.scaling_error},
          {"last_coefficient", shape.last_coefficient},
          {"resolved", shape.resolved()},
          {"iterations", shape.iterations},
          {"gradient_evaluations", shape.gradient_evaluations},
          {"seconds", shape.seconds}};
}

nlohmann::json to_json(const Failure& failure) {
  return {{"reduced_volume", failure.reduced_volume}, {"converged", false}, {"message", failure.message}};
}

std::string row(const Equilibrium& shape) {
  return fmt::format("{:<8g} {:>16.10f} {:>12.8f} {:>11.7f} {:>11.7f} {:>10.7f} {:>10.7f} {:>9.1e} {:>6} {:>8.3f}\n",
                     shape.reduced_volume, shape.energy, shape.energy / sphere_energy, shape.tension, shape.pressure,
                     shape.polar_semi_axis, shape.equatorial_radius, shape.euler_lagrange_residual, shape.iterations,
                     shape.seconds);
}

std::string row(const Failure& failure) {
  return fmt::format("{:<8g} not found: {}\n", failure.reduced_volume, failure.message);
}

}  // namespace

std::string describe(const Equilibrium& shape) {
  return fmt::format("{} {:g}: energy {:.10f}, {} iterations, residual {:.1e}, {:.2f} s", name_of(shape.branch),
                     shape.reduced_volume, shape.energy, shape.iterations, shape.residual, shape.seconds);
}

std::string table(const std::vector<Outcome>& outcomes) {
  std::string text =
      fmt::format("{:<8} {:>16} {:>12} {:>11} {:>11} {:>10} {:>10} {:>9} {:>6} {:>8}\n", "reduced", "bending energy",
                  "over that of", "tension", "pressure", "polar", "equatorial", "residual", "itera-", "");
  text +=
      fmt::format("{:<8} {:>16} {:>12} {:>11} {:>11} {:>10} {:>10} {:>9} {:>6} {:>8}\n", "volume", "(1/2) int H^2 dA",
                  "the sphere", "c_b / r^2", "c_b / r^3", "semi-axis", "radius", "of force", "tions", "seconds");
  for (const Outcome& outcome : outcomes) text += std::visit([](const auto& entry) { return row(entry); }, outcome);
  return text;
}

nlohmann::json to_json(const std::vector<Outcome>& outcomes, Branch branch, int latitudes, Method method) {
  nlohmann::json shapes = nlohmann::json::array();
  for (const Outcome& outcome : outcomes)
    shapes.push_back(std::visit([](const auto& entry) { return to_json(entry); }, outcome));
  return {{"branch", name_of(branch)},
          {"latitudes", latitudes},
          {"method", name_of(method)},
          {"units",
           {{"length", "effective radius r, V = 4 pi r^3 / 3"},
            {"energy", "c_b of (c_b / 2) int H^2 dA, H the mean of the principal curvatures; c_b = 4 kappa"},
            {"tension", "c_b / r^2"},
            {"pressure", "c_b / r^3, inside minus outside"}}},
          {"shapes", shapes}};
}

}  // namespace equilibrium
