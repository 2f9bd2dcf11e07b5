#include "steady_options.h"

#include <fmt/format.h>
#include <omp.h>

#include <cmath>

#include "passive_waiting.h"
#include "program.h"

void require(bool ok, const std::string& option, double given, const std::string& allowed) {
  if (!ok) throw CommandLineError(fmt::format("{} {}: must be {}", option, given, allowed));
}

void declare(CLI::App& command_line, SteadyArguments& arguments, const std::string& tolerance) {
  SteadyOptions& steady = arguments.steady;
  arguments.threads = omp_get_max_threads();
  command_line.add_option("--reynolds-number", arguments.reynolds_number, "Reynolds number")->capture_default_str();
  command_line.add_option("--time-step", steady.time_step, "fixed time step (default: by the Courant number)");
  command_line.add_option("--courant-number", steady.courant_number, "largest dt (|u|/dx + |v|/dy + |w|/dz)")
      ->capture_default_str();
  command_line.add_option("--tolerance", steady.tolerance, "steady at this change " + tolerance)->capture_default_str();
  command_line.add_option("--end", steady.end, "stop at this time even if not steady")->capture_default_str();
  command_line.add_option("--threads", arguments.threads, "threads (default: all cores)");
  command_line.add_flag("--json", arguments.json, "results as JSON on standard output, in place of the tables");
  command_line.add_flag("--quiet", arguments.quiet, "no progress");
}

bool parse(CLI::App& command_line, int argc, char** argv, SteadyArguments& arguments) {
  try {
    command_line.parse(argc, argv);
  } catch (const CLI::Success& help) {
    command_line.exit(help);
    return false;
  } catch (const CLI::ParseError& error) {
    throw CommandLineError(std::string(error.what()) + " (--help lists the options)");
  }
  wait_passively(argv);

  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  const SteadyOptions& steady = arguments.steady;
  require(positive(arguments.reynolds_number), "--reynolds-number", arguments.reynolds_number, "finite and > 0");
  const double time_step = steady.time_step.value_or(1);
  require(positive(time_step), "--time-step", time_step, "finite and > 0");
  require(positive(steady.courant_number) && steady.courant_number <= 1, "--courant-number", steady.courant_number,
          "in (0, 1]");
  require(positive(steady.tolerance), "--tolerance", steady.tolerance, "finite and > 0");
  require(positive(steady.end), "--end", steady.end, "finite and > 0");
  require(arguments.threads >= 1 && arguments.threads <= 1024, "--threads", arguments.threads, "from 1 to 1024");
  omp_set_num_threads(arguments.threads);
  arguments.steady.progress = !arguments.quiet;
  return true;
}
