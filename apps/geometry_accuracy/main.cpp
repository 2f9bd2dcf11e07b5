// Table 1 of the paper: errors of H, K and Lap_Gamma H of known surfaces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>

#include "coefficient_surface.h"
#include "expression_surface.h"
#include "known_surfaces.h"
#include "passive_waiting.h"
#include "report.h"

using namespace vesiflow::vesicle;

namespace {

constexpr int bad_input = 2;
constexpr int largest_latitudes = 256;

const std::map<std::string, LaplacianForm> forms = {{"cartesian", LaplacianForm::cartesian},
                                                    {"christoffel", LaplacianForm::christoffel},
                                                    {"paper", LaplacianForm::paper}};
const std::map<std::string, Upsampling> upsamplings = {
    {"1", Upsampling::none}, {"1.5", Upsampling::three_halves}, {"2", Upsampling::twice}};
const std::map<std::string, bool> truncations = {{"false", false}, {"true", true}};

template <class Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

struct Arguments {
  std::vector<std::string> surfaces = {"sphere", "ellipsoid", "y32"};
  std::vector<int> latitudes = {16, 32, 64, 128};
  std::vector<int> samplings = {1, 2};
  std::vector<std::string> forms = names_of(::forms);
  std::vector<std::string> upsamplings = names_of(::upsamplings);
  std::vector<std::string> truncations = names_of(::truncations);
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
      .add_option("--sampling", arguments.samplings,
                  "1: sample the surface at the markers, as a simulation has it; 2: on twice the latitudes, for the "
                  "Cartesian form")
      ->default_str("1 2")
      ->check(CLI::IsMember({1, 2}));
  const auto add_choice = [&](const char* option, auto& chosen, const auto& values, const char* description) {
    command_line.add_option(option, chosen, description)->default_str("all")->check(CLI::IsMember(names_of(values)));
  };
  add_choice("--formula", arguments.forms, forms, "forms of Lap H");
  add_choice("--upsampling", arguments.upsamplings, upsamplings, "latitudes of the grid of Lap H, over N");
  add_choice("--truncated", arguments.truncations, truncations, "true: Lap H cut to degrees n < N");
  command_line.add_flag("--json", arguments.json, "write a JSON list to standard output");
}

std::unique_ptr<SurfaceSource> surface_of(const std::string& name) {
  if (auto known = make_known_surface(name)) return known;
  const std::filesystem::path file(name);
  if (!std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("--surface {}: must be one of {}, or a file", name, fmt::join(known_surface_names(), ", ")));
  if (file.extension() == ".toml") return std::make_unique<ExpressionSurface>(file);
  return std::make_unique<CoefficientSurface>(file);
}

std::vector<LaplacianOptions> options_of(const Arguments& arguments, int sampling) {
  std::vector<LaplacianOptions> options;
  for (const std::string& form : arguments.forms)
    for (const std::string& truncated : arguments.truncations)
      for (const std::string& upsampling : arguments.upsamplings) {
        const LaplacianOptions choice = {
            .form = forms.at(form), .upsampling = upsamplings.at(upsampling), .truncated = truncations.at(truncated)};
        if (measurable(choice, sampling)) options.push_back(choice);
      }
  return options;
}

int geometry_accuracy(int argc, char** argv) {
  Arguments arguments;
  CLI::App command_line(
      "Errors of mean curvature, Gaussian curvature and the surface Laplacian of the mean curvature "
      "(Table 1 of the paper).",
      "geometry_accuracy");
  declare(command_line, arguments);
  try {
    command_line.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return command_line.exit(error) == 0 ? 0 : bad_input;
  }
  wait_passively(argv);
  Surfaces surfaces;
  for (const std::string& name : arguments.surfaces) surfaces.push_back(surface_of(name));
  std::vector<Measurement> all;
  for (const int sampling : arguments.samplings) {
    const std::vector<LaplacianOptions> options = options_of(arguments, sampling);
    if (options.empty()) continue;
    auto measurements = measure(surfaces, arguments.latitudes, sampling, options);
    if (!arguments.json) fmt::print("{}\n", text_report(measurements));
    std::ranges::move(measurements, std::back_inserter(all));
  }
  if (all.empty())
    throw InputError("--sampling 2: Lap H only with --formula cartesian --upsampling 2 --truncated false");
  if (arguments.json) fmt::print("{}", json_report(all));
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
