// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Equilibrium shapes of vesicles by libvesicle alone.
#include <fmt/format.h>

#include <cstdio>

#include "arguments.h"
#include "output_files.h"
#include "program.h"
#include "report.h"
#include "shape_files.h"
#include "streams.h"

using namespace equilibrium;

namespace {

Outcome compute(const Arguments& arguments, ConstrainedEnergy& energy, double reduced_volume) {
  SolverOptions options;
  options.tolerance = arguments.tolerance;
  options.most_iterations = arguments.most_iterations;
  if (arguments.verbose)
    options.progress = [&](const Iteration& iteration) {
      say("  {:4} energy {:.12f} residual {:.2e}\n", iteration.number, iteration.energy, iteration.residual);
    };
  try {
    const Equilibrium shape = find_equilibrium(energy, arguments.branch, reduced_volume, arguments.method, options);
    if (!arguments.quiet) say("{}\n", describe(shape));
    if (!shape.resolved())
      say("warning: {} {:g}: the force is off by {:.1e} of {:.1e} on this mesh: take more than --latitudes {}, "
          "or less than "
          "--tolerance {:g}\n",
          name_of(shape.branch), shape.reduced_volume, shape.euler_lagrange_residual, shape.largest_force,
          shape.latitudes, arguments.tolerance);
    if (!arguments.out.empty()) write_shape(arguments.out, shape, energy);
    return shape;
  } catch (const NotConverged& failure) {
    say("error: {} {:g}: not converged: {}\n{}\n", name_of(arguments.branch), reduced_volume, failure.what(),
        failure.advice());
    return Failure{reduced_volume, failure.what()};
  }
}

ExitCode run(int argc, char** argv) {
  Arguments arguments;
  if (!read_command_line(argc, argv, arguments)) return success;
  if (!arguments.out.empty()) make_folder(arguments.out);

  ConstrainedEnergy energy(arguments.latitudes);
  std::vector<Outcome> outcomes;
  bool all_found = true;
  for (const double reduced_volume : arguments.reduced_volumes) {
    outcomes.push_back(compute(arguments, energy, reduced_volume));
    all_found = all_found && std::holds_alternative<Equilibrium>(outcomes.back());
  }

  const std::string json = to_json(outcomes, arguments.branch, arguments.latitudes, arguments.method).dump(2) + "\n";
  if (!arguments.out.empty()) write_text(arguments.out / (name_of(arguments.branch) + ".json"), json);
  print_result(arguments.json ? json : table(outcomes));
  return all_found ? success : stopped;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program([&]() -> ExitCode {
    try {
      return run(argc, argv);
    } catch (const MethodMissing& error) {
      throw CommandLineError(error.what());
    }
  });
}
