// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Relaxation rates of small shape modes of a nearly spherical vesicle against theory, for viscosity ratios and resolutions.
//   OMP_WAIT_POLICY=passive build/release/bench/shape_modes [--cells N...] [--ratio L...] [--half B]
// "in sphere": theory with a concentric spherical wall of radius B = 3 or 6. Tabulated in validation/studies/viscosity_ratio.md.
#include <cstdio>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "support/shape_modes.h"
#include "support/timing.h"

namespace {

using namespace vesiflow::coupling;

constexpr double largest_tension_number = 1.4;  // g, with the correction: the explicit tension is unstable from about 2

using Rates = std::vector<std::pair<double, test::Amplitudes>>;  // by spacing

// At spacing 0, by the polynomial through the last three: the error falls as a h + b h^2.
double extrapolated(const Rates& rates, std::size_t mode) {
  const std::size_t first = rates.size() - 3;
  double sum = 0.0;
  for (std::size_t i = first; i < rates.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = first; j < rates.size(); ++j)
      if (j != i) weight *= rates[j].first / (rates[j].first - rates[i].first);
    sum += weight * rates[i].second[mode];
  }
  return sum;
}

void show(double ratio, int cells, double h, int latitudes, double half, const test::Amplitudes& rates,
          double seconds) {
  const auto factors = test::wall_factors(half, ratio);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const int n = static_cast<int>(i) + 2;
    const double theory = test::relaxation_rate(n, ratio, 2.5);
    const double with_wall = factors ? theory * (*factors)[i] : NAN;
    std::printf("%5g %5d %7.4f %4d %3d %9.5f %9.5f %9.4f %9.5f %9.4f %8.1f\n", ratio, cells, h, latitudes, n, rates[i],
                theory, rates[i] / theory, with_wall, rates[i] / with_wall, seconds);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{32, 48, 64};
  std::vector<double> ratios{1.0, 5.0};
  double half = 6.0, refinement = 1.0;
  bool correction = false;
  std::string kernel = "smoothed4";
  CLI::App app{"Relaxation rates of the shape modes 2, 3, 4 of a vesicle in the box [-B,B]^3."};
  app.add_option("--cells", sizes, "numbers of cells along each edge")
      ->check(CLI::Range(16, 256))
      ->capture_default_str();
  app.add_option("--ratio", ratios, "viscosity ratios")->check(CLI::Range(0.05, 100.0))->capture_default_str();
  app.add_option("--half", half, "half of the edge, B")->check(CLI::Range(2.0, 20.0))->capture_default_str();
  app.add_option("--refine", refinement, "markers finer by this factor than spacing h/2")
      ->check(CLI::Range(0.5, 4.0))
      ->capture_default_str();
  app.add_flag("--correction", correction, "coupling.thickness_correction = true");
  app.add_option("--kernel", kernel, "delta function")->check(CLI::IsMember(delta_kernel_names))->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::printf("spacing 0: extrapolated from the three rows before\n");
  std::printf("%5s %5s %7s %4s %3s %9s %9s %9s %9s %9s %8s\n", "ratio", "cells", "h", "lat", "n", "rate", "theory",
              "quotient", "in sphere", "quotient", "s");
  for (const double ratio : ratios) {
    Rates found;
    for (const int cells : sizes) {
      const double h = 2.0 * half / cells;
      const int latitudes = std::max(16, static_cast<int>(std::lround(refinement * M_PI / (0.55 * h) / 4.0)) * 4);
      SimulationParameters scene = test::quarter_of(test::shape_modes(half, cells, latitudes, ratio));
      scene.coupling.kernel = delta_kernel(kernel);
      scene.coupling.thickness_correction = correction;
      if (correction) scene.time.step = std::min(scene.time.step, largest_tension_number * 4.0 * h / 100.0);
      const double seconds =
          1e-3 * vesiflow::bench::timed([&] { found.emplace_back(h, test::measured_rates(scene)); }).wall;
      show(ratio, cells, h, latitudes, half, found.back().second, seconds);
    }
    if (found.size() < 3) continue;
    test::Amplitudes limit{};
    for (std::size_t i = 0; i < limit.size(); ++i) limit[i] = extrapolated(found, i);
    show(ratio, 0, 0.0, 0, half, limit, 0.0);
  }
}
