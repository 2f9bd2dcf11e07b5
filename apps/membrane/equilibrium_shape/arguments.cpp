// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "command_line.h"

namespace equilibrium {
namespace {

constexpr int most_latitudes = 256;
constexpr int most_shapes = 1000;

double parse_number(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw CommandLineError(fmt::format("--reduced-volume {}: must be a number or FROM:TO:STEP", whole));
  return value;
}

}  // namespace

std::vector<double> parse_reduced_volumes(const std::string& text) {
  std::vector<double> parts;
  std::size_t start = 0;
  for (std::size_t colon = 0; colon != std::string::npos; start = colon + 1) {
    colon = text.find(':', start);
    parts.push_back(parse_number(text.substr(start, colon - start), text));
    if (colon == std::string::npos) break;
  }
  if (parts.size() != 1 && parts.size() != 3)
    throw CommandLineError(fmt::format("--reduced-volume {}: must be a number or FROM:TO:STEP", text));
  for (std::size_t end = 0; end < std::min<std::size_t>(parts.size(), 2); ++end)
    if (!(parts[end] > 0 && parts[end] <= 1))
      throw CommandLineError(fmt::format("--reduced-volume {}: reduced volumes must be in (0, 1]", text));
  if (parts.size() == 1) return parts;

  const double from = parts[0], to = parts[1], step = parts[2];
  const double steps = std::abs(to - from) / step;
  if (!(step > 0) || !(steps < most_shapes))
    throw CommandLineError(
        fmt::format("--reduced-volume {}: STEP must be > 0 and give at most {} shapes", text, most_shapes));
  std::vector<double> values;
  for (int k = 0; k <= std::floor(steps + 1e-9); ++k) {
    const double value = from + (to > from ? k : -k) * step;
    values.push_back(std::round(value * 1e12) / 1e12);  // 0.7 and not 0.7000000000000001
  }
  return values;
}

bool read_command_line(int argc, char** argv, Arguments& arguments) {
  CommandLine command_line("equilibrium_shape",
                           "Shapes of least bending energy at given area and volume, without fluid: the axisymmetric "
                           "branches that go over into long (prolate) or flat (oblate) ellipsoids near the sphere.");
  std::string branch, method = name_of(arguments.method), out;
  std::vector<std::string> volumes, method_names;
  for (const auto& [name, value] : methods()) method_names.push_back(name);
  command_line.require_arguments();
  command_line.add_choice("--branch", branch, {"prolate", "oblate"}, "family of shapes")->required();
  command_line.add_option("--reduced-volume", volumes, "in (0, 1]: any number of values or FROM:TO:STEP")
      ->type_name("X")
      ->required();
  command_line.add_option("--latitudes", arguments.latitudes, "of the marker mesh")->capture_default_str();
  command_line.add_choice("--method", method, method_names, "kinsol and cvode are of SUNDIALS")->capture_default_str();
  command_line.add_option("--tolerance", arguments.tolerance, "on the energy's gradient at fixed area and volume")
      ->capture_default_str();
  command_line.add_option("--max-iterations", arguments.most_iterations, "give up after so many (default: by method)");
  command_line.add_out(out, "the shapes (coefficients, meridian) and a summary (default: no files)");
  command_line.add_json(arguments.json);
  command_line.add_flag("--verbose", arguments.verbose, "a line of progress per iteration, on standard error");
  if (!command_line.read(argc, argv)) return false;

  arguments.branch = branch == "prolate" ? Branch::prolate : Branch::oblate;
  for (const auto& [name, value] : methods())
    if (name == method) arguments.method = value;
  require(arguments.latitudes >= ConstrainedEnergy::minimum_latitudes && arguments.latitudes <= most_latitudes,
          "--latitudes", arguments.latitudes,
          fmt::format("from {} to {}", ConstrainedEnergy::minimum_latitudes, most_latitudes));
  require(arguments.tolerance > 0 && arguments.tolerance < 1, "--tolerance", arguments.tolerance, "in (0, 1)");
  require(command_line.count("--max-iterations") == 0 || arguments.most_iterations >= 1, "--max-iterations",
          arguments.most_iterations, ">= 1");
  for (const std::string& text : volumes)
    for (double value : parse_reduced_volumes(text)) arguments.reduced_volumes.push_back(value);
  arguments.out = out;
  arguments.quiet = command_line.is_quiet();
  return true;
}

}  // namespace equilibrium
