// Equilibrium shapes of vesicles by libvesicle alone.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "command_line.h"
#include "report.h"
#include "shape_files.h"

using namespace equilibrium;

namespace {

enum ExitCode { success = 0, internal_error = 1, bad_input = 2, not_converged = 3, file_error = 4 };

Outcome compute(const Arguments& arguments, ConstrainedEnergy& energy, double reduced_volume) {
  SolverOptions options;
  options.tolerance = arguments.tolerance;
  options.most_iterations = arguments.most_iterations;
  if (arguments.verbose)
    options.progress = [&](const Iteration& iteration) {
      fmt::print(stderr, "  {:4} energy {:.12f} residual {:.2e}\n", iteration.number, iteration.energy,
                 iteration.residual);
    };
  try {
    const Equilibrium shape = find_equilibrium(energy, arguments.branch, reduced_volume, arguments.method, options);
    if (!arguments.quiet) fmt::print(stderr, "{}\n", describe(shape));
    if (!shape.resolved())
      fmt::print(
          stderr,
          "{} {:g}: the force is off by {:.1e} of {:.1e} on this mesh: take more than --latitudes {}, or less than "
          "--tolerance {:g}\n",
          name_of(shape.branch), shape.reduced_volume, shape.euler_lagrange_residual, shape.largest_force,
          shape.latitudes, arguments.tolerance);
    if (!arguments.output.empty()) write_shape(arguments.output, shape, energy);
    return shape;
  } catch (const NotConverged& failure) {
    fmt::print(stderr, "{} {:g}: not converged: {}\n{}\n", name_of(arguments.branch), reduced_volume, failure.what(),
               failure.advice());
    return Failure{reduced_volume, failure.what()};
  }
}

ExitCode run(int argc, char** argv) {
  Arguments arguments;
  if (!parse_command_line(argc, argv, arguments)) return success;
  if (!arguments.output.empty()) make_folder(arguments.output);

  ConstrainedEnergy energy(arguments.latitudes);
  std::vector<Outcome> outcomes;
  bool all_found = true;
  for (const double reduced_volume : arguments.reduced_volumes) {
    outcomes.push_back(compute(arguments, energy, reduced_volume));
    all_found = all_found && std::holds_alternative<Equilibrium>(outcomes.back());
  }

  const std::string json = to_json(outcomes, arguments.branch, arguments.latitudes, arguments.method).dump(2) + "\n";
  if (!arguments.output.empty()) write_text(arguments.output / (name_of(arguments.branch) + ".json"), json);
  fmt::print("{}", arguments.json ? json : table(outcomes));
  return all_found ? success : not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const CommandLineError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const MethodMissing& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const FileError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return file_error;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return internal_error;
  }
}
