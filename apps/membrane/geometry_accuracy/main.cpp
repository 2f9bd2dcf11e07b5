// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Table 1 of the paper: errors of H, K and Lap_Gamma H of known surfaces.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>

#include "coefficient_surface.h"
#include "command_line.h"
#include "expression_surface.h"
#include "known_surfaces.h"
#include "program.h"
#include "report.h"

using namespace vesiflow::vesicle;

namespace {

constexpr int least_latitudes = 4, most_latitudes = 256;

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

// Any of the words, all by default.
template <class Value>
void add_words(CommandLine& command_line, const std::string& option, std::vector<std::string>& chosen,
               const std::map<std::string, Value>& values, const std::string& what) {
  const std::vector<std::string> words = names_of(values);
  command_line.complete(option, words);
  command_line.add_option(option, chosen, what)
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->default_str("all");
}

void declare(CommandLine& command_line, Arguments& arguments) {
  command_line
      .add_option("--surface", arguments.surfaces,
                  fmt::format("{}; a .toml file of expressions; or a file of coefficients",
                              fmt::join(known_surface_names(), ", ")))
      ->type_name("FILE")
      ->default_str("sphere ellipsoid y32");
  command_line.complete("--surface", known_surface_names());
  command_line.add_option("--latitudes", arguments.latitudes, "latitudes of the markers, N")
      ->default_str("16 32 64 128");
  command_line
      .add_option("--sampling", arguments.samplings,
                  "1: sample the surface at the markers, as a simulation has it; 2: on twice the latitudes, for the "
                  "Cartesian form")
      ->default_str("1 2");
  add_words(command_line, "--formula", arguments.forms, forms, "forms of Lap H");
  add_words(command_line, "--upsampling", arguments.upsamplings, upsamplings, "latitudes of the grid of Lap H, over N");
  add_words(command_line, "--truncated", arguments.truncations, truncations, "true: Lap H cut to degrees n < N");
  command_line.add_json(arguments.json);
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

ExitCode run(int argc, char** argv) {
  Arguments arguments;
  CommandLine command_line("geometry_accuracy",
                           "Errors of mean curvature, Gaussian curvature and the surface Laplacian of the mean "
                           "curvature (Table 1 of the paper).");
  declare(command_line, arguments);
  if (!command_line.read(argc, argv)) return success;
  for (const int latitudes : arguments.latitudes)
    require(latitudes >= least_latitudes && latitudes <= most_latitudes, "--latitudes", latitudes,
            fmt::format("from {} to {}", least_latitudes, most_latitudes));
  for (const int sampling : arguments.samplings)
    require(sampling == 1 || sampling == 2, "--sampling", sampling, "1 or 2");
  Surfaces surfaces;
  for (const std::string& name : arguments.surfaces) surfaces.push_back(surface_of(name));
  std::vector<Measurement> all;
  for (const int sampling : arguments.samplings) {
    const std::vector<LaplacianOptions> options = options_of(arguments, sampling);
    if (options.empty()) continue;
    auto measurements = measure(surfaces, arguments.latitudes, sampling, options);
    if (!arguments.json) print_result(text_report(measurements) + "\n");
    std::ranges::move(measurements, std::back_inserter(all));
  }
  if (all.empty())
    throw InputError("--sampling 2: Lap H only with --formula cartesian --upsampling 2 --truncated false");
  if (arguments.json) print_result(json_report(all));
  return success;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&]() -> ExitCode {
    try {
      return run(argc, argv);
    } catch (const InputError& error) {
      throw CommandLineError(error.what());
    }
  });
}
