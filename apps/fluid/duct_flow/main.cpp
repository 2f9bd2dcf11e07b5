// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Flow in a rectangular duct against its exact series, by libfluid alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output_files.h"
#include "program.h"
#include "report.h"
#include "steady_options.h"
#include "streams.h"

namespace {

constexpr int fewest_cells = 4, most_cells = 1024, most_refinements = 6;
// Of the box: squares of its lengths and of its spacings, and their inverses, are numbers.
constexpr double shortest = 1e-100, longest = 1e100;

struct Arguments : SteadyArguments {
  Duct duct;
  DuctMethod method = DuctMethod::unsteady;
  std::array<int, 3> cells{};
  int refinements = 0;
  std::string out;
  bool quiet = false;
};

void require_length(const std::string& option, double given) {
  require_positive(option, given);
  require(given >= shortest && given <= longest, option, given, fmt::format("from {:g} to {:g}", shortest, longest));
}

// Cubes as nearly as can be, with `across` cells along y, of which the grids that follow have more.
std::array<int, 3> cells_of(const Duct& duct, int across, int refinements) {
  const int most = vesiflow::fluid::Grid::max_cells >> refinements;
  const auto along = [&](const char* option, double given, double length) {
    const double count = std::round(across * length / (2 * duct.d));
    require(count <= most, option, given,
            fmt::format("short enough for at most {} cells as long as those across the width", most));
    return std::max(fewest_cells, static_cast<int>(count));
  };
  return {duct.ends == DuctEnds::periodic ? fewest_cells : along("--length", duct.length, duct.length), across,
          along("--half-widths", duct.e, 2 * duct.e)};
}

bool parse_command_line(int argc, char** argv, Arguments& arguments) {
  CommandLine command_line(
      "duct_flow",
      "Pressure-driven flow in a rectangular duct, from rest to the steady state, against the exact "
      "series (Eq. 35 of the paper).");
  Duct& duct = arguments.duct;
  std::vector<double> half_widths = {3, 3};
  std::vector<int> cells = {32};
  std::string ends = "periodic";
  double length = 0;
  bool stokes = false;
  command_line
      .add_choice("--ends", ends, {"periodic", "walls"},
                  "driven by a body force, or by the velocity of the series on both ends")
      ->capture_default_str();
  command_line.add_option("--half-widths", half_widths, "along y and z")->expected(2)->default_str("3 3");
  CLI::Option* const given_length = command_line.add_option("--length", length, "of the duct (default: its width)");
  command_line
      .add_option("--cells", cells, "across the width, the others by it (4 along a periodic duct); or along x, y and z")
      ->expected(1, 3)
      ->default_str("32");
  command_line
      .add_option("--refine", arguments.refinements, "so many grids more, each with twice the cells of the last")
      ->capture_default_str();
  command_line.add_flag("--stokes", stokes, "solve the Stokes problem at once, without inertia and time");
  declare(command_line, arguments,
          "of the velocity per diffusion time, largest velocity 1 (--stokes: relative residual)");
  command_line.add_out(arguments.out, "the results as JSON, and the flow in a cross-section (default: no files)");
  if (!read(command_line, argc, argv, arguments)) return false;

  arguments.quiet = command_line.is_quiet();
  duct.ends = ends == "walls" ? DuctEnds::walls : DuctEnds::periodic;
  for (const double width : half_widths) require_length("--half-widths", width);
  duct.d = half_widths[0];
  duct.e = half_widths[1];
  if (given_length->count() > 0) require_length("--length", length);
  duct.length = given_length->count() > 0 ? length : 2 * duct.d;
  duct.reynolds_number = arguments.reynolds_number;
  arguments.method = stokes ? DuctMethod::stokes : DuctMethod::unsteady;
  require(arguments.refinements >= 0 && arguments.refinements <= most_refinements, "--refine", arguments.refinements,
          fmt::format("from 0 to {}", most_refinements));
  if (cells.size() == 2) throw CommandLineError("--cells: must be one number or three");
  for (const int count : cells)
    require(count >= fewest_cells && count <= most_cells, "--cells", count,
            fmt::format("from {} to {}", fewest_cells, most_cells));
  for (const int count : cells)
    require(count << arguments.refinements <= most_cells, "--refine", arguments.refinements,
            fmt::format("small enough for at most {} cells along an axis", most_cells));
  arguments.cells =
      cells.size() == 3 ? std::array{cells[0], cells[1], cells[2]} : cells_of(duct, cells[0], arguments.refinements);
  return true;
}

std::array<int, 3> refined(const Arguments& arguments, int times) {
  std::array<int, 3> cells = arguments.cells;
  for (int axis = 0; axis < 3; ++axis)
    if (axis > 0 || arguments.duct.ends == DuctEnds::walls)
      cells[axis] <<= times;  // a periodic flow is the same at all x
  return cells;
}

ExitCode run(int argc, char** argv) {
  Arguments arguments;
  if (!parse_command_line(argc, argv, arguments)) return success;
  const std::filesystem::path folder = arguments.out;
  if (!folder.empty()) make_folder(folder);

  std::vector<DuctFlow> flows;
  std::string json;
  bool all_steady = true;
  for (int times = 0; times <= arguments.refinements; ++times) {
    const std::array<int, 3> cells = refined(arguments, times);
    const std::string name = fmt::format("{}x{}x{}", cells[0], cells[1], cells[2]);
    if (!arguments.quiet) say("{} cells\n", name);
    flows.push_back(compute_duct(arguments.duct, cells, arguments.method, arguments.steady));
    const SteadyRun& last = flows.back().run;
    if (!last.steady) say("error: {} cells: not steady at time {:g}: change {:.1e}\n", name, last.time, last.change);
    all_steady = all_steady && last.steady;
    json = to_json(arguments.duct, arguments.method, flows).dump(1) + "\n";
    if (folder.empty()) continue;
    write_text(folder / fmt::format("cross_section_{}.csv", name), cross_section(arguments.duct, flows.back()));
    write_text(folder / "duct_flow.json", json);
  }
  print_result(arguments.json ? json : table(arguments.duct, arguments.method, flows));
  return all_steady ? success : stopped;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&] { return run(argc, argv); });
}
