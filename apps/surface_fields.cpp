// Every quantity of a surface at its markers, as a table for plotting: a look at a shape before it is simulated.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>

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
  std::filesystem::path out = "out/surface_fields";
};

VectorField markers(const Options& options, const SphereGrid& grid) {
  if (options.surface == "sphere") return sphere(grid);
  if (options.surface == "prolate") return prolate(grid, options.reduced_volume);
  if (options.surface == "oblate") return oblate(grid, options.reduced_volume);
  if (options.surface == "ellipsoid") return ellipsoid(grid, Vector3(options.axes.data()));
  if (options.surface == "biconcave") return biconcave_disc(grid);
  const std::filesystem::path file = options.surface;
  if (std::error_code error; !std::filesystem::exists(file, error))
    throw std::runtime_error(fmt::format(
        "surface = {}: neither a file nor one of sphere, prolate, oblate, ellipsoid, biconcave", options.surface));
  if (is_triangle_mesh_file(file)) {
    const TriangleMesh mesh = read_triangle_mesh(file);
    const int degrees = options.fit_degrees.value_or(default_fit_degrees(mesh.vertices.rows(), grid.latitudes()));
    const MeshFit fit = fit_mesh(mesh, degrees);
    fmt::print("{}: {}\n", file.string(), description(fit));
    return shape_from_coefficients(grid, fit.surface);
  }
  return shape_from_coefficients(grid, read_surface_coefficients(file));
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
  void write(const std::filesystem::path& path) const {
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (Eigen::Index k = 0; k < columns.front().size(); ++k)
      for (std::size_t c = 0; c < columns.size(); ++c)
        fmt::format_to(std::back_inserter(text), "{:.10g}{}", columns[c][k], c + 1 < columns.size() ? ',' : '\n');
    std::ofstream stream(path);
    stream << text << std::flush;
    if (!stream) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
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

void print_summary(const Surface& surface) {
  const VolumeMoments moments = volume_moments(surface);
  const MeshQuality quality = mesh_quality(surface);
  const Resolution how_fine = resolution(surface);
  const auto line = [](const char* name, const std::string& value) { fmt::print("{:24} {}\n", name, value); };
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
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app{
      "Writes every quantity of a surface at its markers as CSV, and its spectrum; draw with tools/plot_surface.py."};
  app.add_option("surface", options.surface,
                 "sphere, prolate, oblate, ellipsoid, biconcave, or a file: coefficients, or a triangle mesh (OBJ, "
                 "OFF, PLY, STL)")
      ->capture_default_str();
  app.add_option("--latitudes", options.latitudes, "N; 2 N^2 markers")
      ->check(CLI::Range(4, 512))
      ->capture_default_str();
  app.add_option("--reduced-volume", options.reduced_volume, "of a prolate or oblate")->capture_default_str();
  app.add_option("--axes", options.axes, "proportions of an ellipsoid")->expected(3)->capture_default_str();
  app.add_option("--fit-degrees", options.fit_degrees,
                 "degrees of the fit to a triangle mesh; unless given, as many as it determines, at most 32");
  app.add_option("--out", options.out, "folder")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(fmt::format("{} (--help lists the options)", error.what()));
  }
  Surface surface(options.latitudes);
  surface.update(markers(options, surface.grid()), GeometryDetail::curvature);
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error)
    throw std::runtime_error(fmt::format("--out {}: cannot be made: {}", options.out.string(), error.message()));
  marker_table(surface).write(options.out / "markers.csv");
  spectrum_table(surface).write(options.out / "spectrum.csv");
  print_summary(surface);
  fmt::print("tables in {}\n", options.out.string());
} catch (const std::exception& error) {
  fmt::print(stderr, "error: {}\n", error.what());
  return 2;
}
