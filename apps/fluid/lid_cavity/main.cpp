// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The lid-driven cube against published profiles, by libfluid alone.
#include <fmt/format.h>

#include "output_files.h"
#include "program.h"
#include "report.h"
#include "steady_options.h"
#include "streams.h"

using namespace cavity;

namespace {

constexpr int fewest_cells = 8, most_cells = 512;

struct Arguments : SteadyArguments {
  std::vector<int> cells = {32};
  std::string out;
  bool quiet = false;
};

bool parse_command_line(int argc, char** argv, Arguments& arguments) {
  arguments.reynolds_number = albensoeder_kuhlmann::reynolds_number;
  arguments.steady.tolerance = 1e-6;
  CommandLine command_line(
      "lid_cavity",
      "Steady flow in a cube with a moving lid: velocities on the centrelines, beside published ones "
      "at Reynolds number 1000.");
  command_line
      .add_option("--cells", arguments.cells,
                  "cells along each edge; each of several grids starts from the flow on the one before")
      ->default_str("32");
  declare(command_line, arguments, "of the velocity per unit time (lid's velocity and edge are 1)");
  command_line.add_out(arguments.out, "the results as JSON, and the flow in the mid-plane (default: no files)");
  if (!read(command_line, argc, argv, arguments)) return false;
  arguments.quiet = command_line.is_quiet();
  for (const int cells : arguments.cells)
    require(cells >= fewest_cells && cells <= most_cells, "--cells", cells,
            fmt::format("from {} to {}", fewest_cells, most_cells));
  return true;
}

ExitCode run(int argc, char** argv) {
  Arguments arguments;
  if (!parse_command_line(argc, argv, arguments)) return success;
  const std::filesystem::path folder = arguments.out;
  if (!folder.empty()) make_folder(folder);

  std::vector<CavityFlow> flows;
  std::string json;
  bool all_steady = true;
  for (const int cells : arguments.cells) {
    if (!arguments.quiet) say("{}^3 cells\n", cells);
    flows.push_back(compute_cavity(cells, arguments.reynolds_number, arguments.steady,
                                   flows.empty() ? nullptr : &flows.back().velocity));
    const SteadyRun& last = flows.back().run;
    if (!last.steady)
      say("error: {}^3 cells: not steady at time {:g}: it changes by {:.1e} per unit time\n", cells, last.time,
          last.change);
    all_steady = all_steady && last.steady;
    json = to_json(flows, arguments.reynolds_number).dump(1) + "\n";
    if (folder.empty()) continue;
    write_text(folder / fmt::format("mid_plane_{}.csv", cells), mid_plane(flows.back()));
    write_text(folder / "lid_cavity.json", json);
  }
  print_result(arguments.json ? json : table(flows, arguments.reynolds_number));
  return all_steady ? success : stopped;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&] { return run(argc, argv); });
}
