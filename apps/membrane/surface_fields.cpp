// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Every quantity of a surface at its markers, as a table for plotting: a look at a shape before it is simulated.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <optional>

#include "command_line.h"
#include "output_files.h"
#include "program.h"
#include "streams.h"
#include "vesicle/bending.h"
#include "vesicle/diagnostics.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/mesh_quality.h"
#include "vesicle/shapes.h"
#include "vesicle/surface_file.h"
#include "vesicle/tension.h"
#include "vesicle/triangle_mesh_file.h"

namespace {

using namespace vesiflow::vesicle;

struct Options {
  std::string surface = "biconcave";
  int latitudes = 32;
  double reduced_volume = 0.9;
  std::vector<double> axes{1, 2, 4};
  std::optional<int> fit_degrees;
  std::string out = "out/surface_fields";
};

constexpr int least_latitudes = 4, most_latitudes = 512;

VectorField markers(const Options& options, const SphereGrid& grid) {
  if (options.surface == "sphere") return sphere(grid);
  if (options.surface == "prolate") return prolate(grid, options.reduced_volume);
  if (options.surface == "oblate") return oblate(grid, options.reduced_volume);
  if (options.surface == "ellipsoid") return ellipsoid(grid, Vector3(options.axes.data()));
  if (options.surface == "biconcave") return biconcave_disc(grid);
  const std::filesystem::path file = options.surface;
  if (std::error_code error; !std::filesystem::exists(file, error))
    throw CommandLineError(fmt::format(
        "surface = {}: neither a file nor one of sphere, prolate, oblate, ellipsoid, biconcave", options.surface));
  try {
    if (is_triangle_mesh_file(file)) {
      const TriangleMesh mesh = read_triangle_mesh(file);
      const int degrees = options.fit_degrees.value_or(default_fit_degrees(mesh.vertices.rows(), grid.latitudes()));
      const MeshFit fit = fit_mesh(mesh, degrees);
      print_result(fmt::format("{}: {}\n", file.string(), description(fit)));
      return shape_from_coefficients(grid, fit.surface);
    }
    return shape_from_coefficients(grid, read_surface_coefficients(file));
  } catch (const std::runtime_error& error) {
    throw CommandLineError(error.what());
  }
}

/// Scalar columns with their names.
struct Table {
  void add(const std::string& name, const ScalarField& values) {
    names.push_back(name);
    columns.push_back(values);
  }
  void add(const std::string& name, const VectorField& values) {
    for (int component = 0; component < 3; ++component)
      add(fmt::format("{}_{}", name, "xyz"[component]), ScalarField(values.col(component)));
  }
  std::string text() const {
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (Eigen::Index k = 0; k < columns.front().size(); ++k)
      for (std::size_t c = 0; c < columns.size(); ++c)
        fmt::format_to(std::back_inserter(text), "{:.10g}{}", columns[c][k], c + 1 < columns.size() ? ',' : '\n');
    return text;
  }
  std::vector<std::string> names;
  std::vector<ScalarField> columns;
};

ScalarField per_marker(const SphereGrid& grid, bool colatitude) {
  ScalarField values(grid.size());
  for (int j = 0; j < grid.latitudes(); ++j)
    for (int i = 0; i < grid.longitudes(); ++i)
      values[grid.index(i, j)] = colatitude ? grid.colatitude()[j] : grid.longitude(i);
  return values;
}

Table marker_table(const Surface& surface) {
  const SphereGrid& grid = surface.grid();
  Table table;
  table.add("colatitude", per_marker(grid, true));
  table.add("longitude", per_marker(grid, false));
  table.add("position", surface.positions());
  table.add("normal", surface.normal());
  table.add("area_weight", surface.area_weight());
  table.add("mean_curvature", surface.mean_curvature());
  table.add("gaussian_curvature", surface.gaussian_curvature());
  ScalarField laplacian;
  LaplaceBeltrami(grid).of_mean_curvature(surface, laplacian);
  table.add("laplacian_of_mean_curvature", laplacian);
  VectorField force = VectorField::Zero(grid.size(), 3);
  BendingForce(grid, {.capillary_number = 1, .spontaneous_curvature = 0, .laplacian = {}}).add_to(surface, force);
  table.add("bending_force", force);
  // The tension of a membrane that was of the area of the sphere's cells, all stretched alike on average: what the markers of this
  // mesh would feel if the surface had been blown up from the sphere of equal area.
  const double measure = surface.area() / (4 * std::numbers::pi);
  ScalarField target(grid.size());
  for (int j = 0; j < grid.latitudes(); ++j)
    target.segment(grid.index(0, j), grid.longitudes())
        .setConstant(measure * grid.weight()[j] * grid.longitude_spacing());
  TensionForce tension_force({.sigma0 = 1});
  ScalarField tension;
  tension_force.evaluate(surface, target, tension);
  force.setZero();
  tension_force.add_to(surface, tension, force);
  table.add("tension", tension);
  table.add("tension_force", force);
  return table;
}

Table spectrum_table(const Surface& surface) {
  const Spectrum curvature = mean_curvature_spectrum(surface);
  const Spectrum positions(surface.position_coefficients());
  ScalarField degree(curvature.degrees()), law(curvature.degrees());
  for (int n = 0; n < curvature.degrees(); ++n) {
    degree[n] = n;
    law[n] = curvature.extrapolated(n);
  }
  const auto column = [](const std::vector<double>& v) -> ScalarField {
    return Eigen::Map<const Eigen::ArrayXd>(v.data(), Eigen::Index(v.size()));
  };
  Table table;
  table.add("degree", degree);
  table.add("positions", column(positions.amplitude()));
  table.add("mean_curvature", column(curvature.amplitude()));
  table.add("mean_curvature_law", law);
  return table;
}

std::string summary_of(const Surface& surface) {
  std::string text;
  const VolumeMoments moments = volume_moments(surface);
  const MeshQuality quality = mesh_quality(surface);
  const Resolution how_fine = resolution(surface);
  const auto line = [&](const char* name, const std::string& value) { text += fmt::format("{:24} {}\n", name, value); };
  const auto range = [](const ScalarField& f) { return fmt::format("{:.6g} to {:.6g}", f.minCoeff(), f.maxCoeff()); };
  line("area, volume", fmt::format("{:.8g}, {:.8g}", surface.area(), surface.volume()));
  line("reduced volume", fmt::format("{:.6f}", reduced_volume(surface.area(), surface.volume())));
  line("excess area", fmt::format("{:.6g}", excess_area(surface.area(), surface.volume())));
  line("semi-axes",
       fmt::format("{:.5g}, {:.5g}, {:.5g}", moments.semi_axes[0], moments.semi_axes[1], moments.semi_axes[2]));
  line("mean curvature H", range(surface.mean_curvature()));
  line("Gaussian curvature K", range(surface.gaussian_curvature()));
  line("int K dA / 4 pi",
       fmt::format("{:.12g}", surface.integral(surface.gaussian_curvature()) / (4 * std::numbers::pi)));
  line("bending energy / 2 pi", fmt::format("{:.8g}", bending_energy(surface) / (2 * std::numbers::pi)));
  line("mesh", fmt::format("aspect ratio {:.3g}, area ratio {:.3g}", quality.aspect_ratio, quality.area_ratio));
  line("resolution", how_fine.sufficient() ? fmt::format("sufficient, {:.1e} of Lap H unresolved", how_fine.unresolved)
                                           : resolution_warning(how_fine));
  return text;
}

const std::vector<std::string> shapes = {"sphere", "prolate", "oblate", "ellipsoid", "biconcave"};

void declare(CommandLine& command_line, Options& options) {
  command_line
      .add_option(
          "surface", options.surface,
          fmt::format("{}; or a file: coefficients, or a triangle mesh (OBJ, OFF, PLY, STL)", fmt::join(shapes, ", ")))
      ->type_name("FILE")
      ->capture_default_str();
  command_line.complete("surface", shapes);
  command_line.add_option("--latitudes", options.latitudes, "N; 2 N^2 markers")->capture_default_str();
  command_line.add_option("--reduced-volume", options.reduced_volume, "of a prolate or oblate")->capture_default_str();
  command_line.add_option("--axes", options.axes, "proportions of an ellipsoid")->expected(3)->default_str("1 2 4");
  command_line.add_option("--fit-degrees", options.fit_degrees,
                          "degrees of the fit to a triangle mesh; unless given, as many as it determines, at most 32");
  command_line.add_out(options.out, "the tables")->capture_default_str();
}

ExitCode run(int argc, char** argv) {
  Options options;
  CommandLine command_line(
      "surface_fields",
      "Writes every quantity of a surface at its markers as CSV, and its spectrum; draw with tools/plot_surface.py.");
  declare(command_line, options);
  if (!command_line.read(argc, argv)) return success;
  require(options.latitudes >= least_latitudes && options.latitudes <= most_latitudes, "--latitudes", options.latitudes,
          fmt::format("from {} to {}", least_latitudes, most_latitudes));
  const std::filesystem::path folder = options.out;
  Surface surface(options.latitudes);
  surface.update(markers(options, surface.grid()), GeometryDetail::curvature);
  make_folder(folder);
  write_text(folder / "markers.csv", marker_table(surface).text());
  write_text(folder / "spectrum.csv", spectrum_table(surface).text());
  print_result(summary_of(surface));
  if (!command_line.is_quiet()) say("tables in {}\n", folder.string());
  return success;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&] { return run(argc, argv); });
}
