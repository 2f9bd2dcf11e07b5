// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The indicator of a membrane against the exact one, and what it costs.
//   OMP_WAIT_POLICY=passive build/release/bench/indicator [--cells N...]
#include <algorithm>
#include <cstdio>
#include <vector>

#include <CLI/CLI.hpp>

#include "indicator_cases.h"
#include "support/timing.h"

namespace {

using namespace vesiflow;
using coupling::Indicator;
using coupling::test::SolidEllipsoid;

double milliseconds(Indicator& indicator, const vesicle::Surface& surface, fluid::Field<fluid::Cell>& field) {
  double least = 1e300;
  for (int n = 0; n < 15; ++n) {
    const auto one = [&] {
      indicator.add(0, surface, 1.0);
      indicator.solve(field);
    };
    least = std::min(least, bench::timed(one).wall);
  }
  return least;
}

void show(const char* what, int cells, double h, const coupling::test::IndicatorErrors& e, double time) {
  std::printf("%-22s %5d %7.4f %9.2e %9.2e %9.2e %8.4f %9.2e %9.2e %8.2f\n", what, cells, h, e.far, e.above, e.below,
              e.mean / h, e.volume, e.limited_volume, time);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes{16, 32, 64, 128};
  CLI::App app{"Errors of the indicator in the box [-3,3]^3, by number of cells."};
  app.add_option("--cells", sizes, "numbers of cells along each edge")
      ->check(CLI::Range(16, 512))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  std::printf("far: max error further than 0.75 from the surface; mean: integral of the error per area and spacing\n");
  std::printf("%-22s %5s %7s %9s %9s %9s %8s %9s %9s %8s\n", "", "cells", "h", "far", "above 1", "below 0", "mean/h",
              "volume", "limited", "ms");
  const SolidEllipsoid sphere{{1, 1, 1}, {0.03, 0.02, -0.04}}, ellipsoid{{0.7, 1.0, 1.6}, {0.03, 0.02, -0.04}};
  for (const auto& [name, shape] : {std::pair{"sphere", sphere}, {"ellipsoid", ellipsoid}}) {
    for (const int cells : sizes) {
      const fluid::Grid grid({-3, -3, -3}, {3, 3, 3}, {cells, cells, cells});
      const vesicle::Surface surface = shape.surface(std::max(16, cells));
      fluid::Field<fluid::Cell> field(grid);
      Indicator indicator(grid, 1);
      const double time = milliseconds(indicator, surface, field);
      const auto errors = [&] { return coupling::test::indicator_errors(field, shape, surface.area(), 0.75); };
      show(name, cells, grid.spacing(0), errors(), time);
      coupling::test::dirichlet_indicator(surface, field);
      show("  with Dirichlet", cells, grid.spacing(0), errors(), 0.0);
    }
  }
}
