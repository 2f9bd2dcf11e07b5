// Table 1 of the paper: errors of H, K and Lap_Gamma H of known surfaces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>

#include "geometry_accuracy/coefficient_surface.h"
#include "geometry_accuracy/expression_surface.h"
#include "geometry_accuracy/known_surfaces.h"
#include "geometry_accuracy/report.h"

using namespace vesiflow::vesicle;

namespace {

constexpr int bad_input = 2;
constexpr int largest_latitudes = 256;

const std::map<std::string, LaplacianForm> forms = {{"cartesian", LaplacianForm::cartesian},
                                                    {"christoffel", LaplacianForm::christoffel},
                                                    {"paper", LaplacianForm::paper}};
const std::map<std::string, Upsampling> upsamplings = {
    {"1", Upsampling::none}, {"1.5", Upsampling::three_halves}, {"2", Upsampling::twice}};

struct Arguments {
  std::vector<std::string> surfaces = {"sphere", "ellipsoid", "y32"};
  std::vector<int> latitudes = {16, 32, 64, 128};
  int sampling = 1;
  std::vector<LaplacianForm> forms = {LaplacianForm::cartesian, LaplacianForm::christoffel, LaplacianForm::paper};
  std::vector<Upsampling> upsamplings = {Upsampling::none, Upsampling::three_halves, Upsampling::twice};
  std::vector<bool> truncated = {false, true};
  bool json = false;
};

void declare(CLI::App& command_line, Arguments& arguments) {
  command_line
      .add_option("--surface", arguments.surfaces,
                  fmt::format("surfaces: {}; a .toml file of expressions; or a file of coefficients",
                              fmt::join(known_surface_names(), ", ")))
      ->default_str("sphere ellipsoid y32");
  command_line.add_option("--latitudes", arguments.latitudes, "latitudes of the markers, N")
      ->default_str("16 32 64 128")
      ->check(CLI::Range(4, largest_latitudes));
  command_line
      .add_option("--sampling", arguments.sampling,
                  "1: sample the surface at the markers, as a simulation has it; 2: on twice the latitudes")
      ->check(CLI::IsMember({1, 2}));
  command_line.add_option("--formula", arguments.forms, "forms of Lap H: cartesian, christoffel, paper (default all)")
      ->transform(CLI::CheckedTransformer(forms).description(""));
  command_line.add_option("--upsampling", arguments.upsamplings, "upsampling of Lap H: 1, 1.5, 2 (default all)")
      ->transform(CLI::CheckedTransformer(upsamplings).description(""));
  command_line
      .add_option("--truncated", arguments.truncated, "true: Lap H cut to degrees n < N; false: not (default both)")
      ->expected(1);
  command_line.add_flag("--json", arguments.json, "write a JSON list to standard output");
}

std::unique_ptr<SurfaceSource> surface_of(const std::string& name) {
  if (auto known = make_known_surface(name)) return known;
  const std::filesystem::path file(name);
  if (!std::filesystem::exists(file))
    throw InputError(fmt::format("--surface {}: must be one of {}, or a file", name,
                                 fmt::join(known_surface_names(), ", ")));
  if (file.extension() == ".toml") return std::make_unique<ExpressionSurface>(file);
  return std::make_unique<CoefficientSurface>(file);
}

std::vector<LaplacianOptions> options_of(const Arguments& arguments) {
  std::vector<LaplacianOptions> options;
  for (const LaplacianForm form : arguments.forms)
    for (const bool truncated : arguments.truncated)
      for (const Upsampling upsampling : arguments.upsamplings) {
        const LaplacianOptions choice = {.form = form, .upsampling = upsampling, .truncated = truncated};
        if (measurable(choice, arguments.sampling)) options.push_back(choice);
      }
  if (options.empty())
    throw InputError(fmt::format("--sampling {}: Lap H only with --formula cartesian --upsampling 2 --truncated false",
                                 arguments.sampling));
  return options;
}

int geometry_accuracy(int argc, char** argv) {
  Arguments arguments;
  CLI::App command_line("Errors of mean curvature, Gaussian curvature and the surface Laplacian of the mean curvature "
                        "(Table 1 of the paper).",
                        "geometry_accuracy");
  declare(command_line, arguments);
  try {
    command_line.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return command_line.exit(error) == 0 ? 0 : bad_input;
  }
  Surfaces surfaces;
  for (const std::string& name : arguments.surfaces) surfaces.push_back(surface_of(name));
  const auto measurements = measure(surfaces, arguments.latitudes, arguments.sampling, options_of(arguments));
  fmt::print("{}", arguments.json ? json_report(measurements) : text_report(measurements));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return geometry_accuracy(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return 1;
  }
}
